// What a case will cost, before anything runs.
#pragma once

#include <cstddef>

#include "strandlab/case/case.hpp"

namespace strandlab::cases {

struct Estimate {
  std::size_t strands = 0;
  std::size_t particles = 0;
  std::size_t cells = 0;  // of the background grid between the platens
  double cell_length_mm = 0, cell_height_mm = 0;
  double time_step_s = 0;      // at the start
  double pressing_time_s = 0;  // simulated
  double steps = 0;
  double memory_bytes = 0;
  double disk_bytes = 0;  // of the run folder
  double press_s = 0;     // wall time
  double test_s = 0;
};

// Time step = courant * min over strands and axes of d/c with c = sqrt(C_axis/density), d the cell's size; steps =
// pressing time over time step. Wall time and memory from measured costs per particle (docs/performance.md).
Estimate estimate(const Case& c, const Panel<2>& panel);

// Material points of the panel that make_panel() would make of this mat.
double particle_count(const Case& c, const mat::Mat& mat);
// Throws InputError when pressing the mat needs more memory than is free (core/free_memory.hpp).
void refuse_too_large(const Case& c, const mat::Mat& mat);
// The same before a mat is formed, from the means of its rows: throws InputError when half of what they make of it
// would not fit, so that no such mat is formed at all.
void refuse_too_large(const Case& c, const mat::Layup& layup);

// Threads of a run: what the case says, or one per core of this machine.
int thread_count(const Case& c);

}  // namespace strandlab::cases
