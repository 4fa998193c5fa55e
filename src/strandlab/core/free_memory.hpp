// How much memory a run may still take.
#pragma once

namespace strandlab {

// Bytes this process can still allocate: what the machine has available, or less where a limit on the address space
// (ulimit -v) or the control groups of a batch system or container allow less. Infinite where nothing can be found out.
double free_memory_bytes();

}  // namespace strandlab
