// Which builds of the kernels this machine can run, and which one runs.
#pragma once

#include <string>
#include <vector>

namespace strandlab::mpm {

inline constexpr const char* kInstructionSetVariable = "STRANDLAB_ISA";  // of the environment

// "avx512", "avx2", "generic": those that this program was built with and this processor has, the best one first.
std::vector<std::string> instruction_sets();

// The one that engines made now use: the best, or the one that STRANDLAB_ISA names. Throws InputError when that is none
// of instruction_sets().
std::string instruction_set();

}  // namespace strandlab::mpm
