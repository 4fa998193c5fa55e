// A stopwatch for the phases of the kernels.
#pragma once

#include <time.h>

#include "strandlab/mpm/kernels/pack.hpp"

namespace strandlab::mpm::STRANDLAB_ISA {
namespace {

// A cheap clock: ticks of constant rate, converted to seconds by the engine.
STRANDLAB_INLINE double now() {
#if defined(__x86_64__)
  return static_cast<double>(__builtin_ia32_rdtsc());
#else
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
#endif
}

// Adds the time since it was last read to a total, when the engine is timed.
struct Stopwatch {
  bool on;
  double t;
  explicit Stopwatch(bool timed) : on(timed), t(timed ? now() : 0) {}
  STRANDLAB_INLINE void operator()(double& total) {
    if (!on) return;
    const double s = now();
    total += s - t;
    t = s;
  }
};

}  // namespace
}  // namespace strandlab::mpm::STRANDLAB_ISA
