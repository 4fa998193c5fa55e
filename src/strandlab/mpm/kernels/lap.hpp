// A clock for profiling the kernels.
#pragma once

#include <time.h>

#include "strandlab/mpm/kernels/pack.hpp"

namespace strandlab::mpm::STRANDLAB_ISA {
namespace {

// A cheap clock for profiling: ticks of constant rate, converted to seconds by the engine.
STRANDLAB_INLINE double now() {
#if defined(__x86_64__)
  return static_cast<double>(__builtin_ia32_rdtsc());
#else
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
#endif
}

// Adds the time since the last lap to a total, when profiling.
struct Lap {
  bool on;
  double t;
  explicit Lap(bool profile) : on(profile), t(profile ? now() : 0) {}
  STRANDLAB_INLINE void operator()(double& total) {
    if (!on) return;
    const double s = now();
    total += s - t;
    t = s;
  }
};

}  // namespace
}  // namespace strandlab::mpm::STRANDLAB_ISA
