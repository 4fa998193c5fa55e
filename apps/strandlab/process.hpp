// What the program asks of its process before it does anything: descriptors, signals, threads of the libraries.
#pragma once

namespace strandlab::app {

// To be called first in main(). Puts something on standard descriptors that are closed, so that no result file gets
// their number and a message written into it: reading there ends, writing fails. A lost reader (SIGPIPE) or a file
// beyond the limit on its size (SIGXFSZ) is a failed write with a message, not the end of the process. A hang-up ends
// the process as it ends any other unless nohup or the shell says otherwise; the run goes on from its checkpoint.
void prepare_process();

}  // namespace strandlab::app
