// XPIC(2) filter of the particle velocities.
#pragma once

#include <vector>

#include "strandlab/mpm/fields.hpp"

namespace strandlab::mpm {

// XPIC(2), Hammerquist & Nairn (2017): particle velocities become S (2 v - P S v), where S interpolates from the
// grid, P projects to it and v is the grid's new velocity. Removes the part of the particle velocities that the grid
// does not see; linear momentum is untouched.
class VelocityFilter {
 public:
  // After the particles have moved. Returns the kinetic energy it takes, mJ.
  template <int Dim>
  double apply(const Step<Dim>& step, const Fields& fields, std::vector<Particles<Dim>>& bodies);
  std::size_t bytes() const { return projected_.bytes(); }

 private:
  AlignedArray projected_;  // P S v: Dim per record of fields.nodes
};

}  // namespace strandlab::mpm
