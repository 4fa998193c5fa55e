// What the machine itself can do, measured in the same run as the program's own figures.
#pragma once

namespace strandlab::benchmark {

struct MachineLimits {
  double fma_gflops = 0;  // multiply-adds in registers, double precision
  double triad_gb_s = 0;  // a = b + s c over arrays far larger than the caches; bytes counted as three arrays
};

// Best of several short runs on `threads` threads.
MachineLimits machine_limits(int threads);

}  // namespace strandlab::benchmark
