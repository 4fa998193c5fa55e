// The standard benchmark: the main job's mat on 1:1 cells, elastic and mid-press, and its static solves.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "strandlab/benchmark/machine.hpp"
#include "strandlab/mpm/engine.hpp"

namespace strandlab::benchmark {

struct Result {
  int threads = 1;
  double elastic_ns_per_particle_step = 0;   // strands that touch and press on each other but do not yield
  double press_ns_per_particle_step = 0;     // at kMidPress compaction
  double one_body_ns_per_particle_step = 0;  // elastic, the same number of particles as one body: what contact costs
  double elastic_3d_ns_per_particle_step = 0;
  double plastic_fraction = 0;                   // of the particles, mid-press
  double fields_per_node = 0;                    // mid-press
  double static_solve_s = 0;                     // per 1/D_t: assembly, factor, solves; 3 elements through a strand
  double static_solve_fine_s = 0;                // at 6 elements through a strand
  double bytes_per_particle = 0;                 // held by the engine
  double peak_memory_mb = 0;                     // of the whole process, static solves included
  mpm::Phases elastic_phases{}, press_phases{};  // ns per particle-step
  MachineLimits machine;
};

inline constexpr double kMidPress = 0.2;

// 1, 2, 4... up to `most` threads, which is the last; 0: all cores.
std::vector<int> thread_counts(int most);

// Medians of `repeats` measurements for each thread count. `say` is told what is being measured.
std::vector<Result> run(const std::vector<int>& threads, int repeats,
                        const std::function<void(const std::string&)>& say);

}  // namespace strandlab::benchmark
