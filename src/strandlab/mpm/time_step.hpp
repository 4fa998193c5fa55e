// The longest time step that the waves in the bodies allow.
#pragma once

#include <vector>

#include "strandlab/mpm/particles.hpp"

namespace strandlab::mpm {

template <int Dim>
struct StepLimit {
  double time_s = 1e300;                 // in which the fastest wave crosses a cell
  const Particles<Dim>* body = nullptr;  // where that is, null: no particles
  const double* particle = nullptr;
};

// From wave speeds along the panel's axes and the particles' own speed, in a sample of the particles.
template <int Dim>
StepLimit<Dim> step_limit(const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step);

}  // namespace strandlab::mpm
