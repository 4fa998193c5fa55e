// The end planes of a panel: held, moved, and what they carry. Per mm of depth throughout.
#pragma once

#include <vector>

#include "strandlab/vtest/model.hpp"

namespace strandlab::vtest {

// Both end planes held in x.
statics::Supports end_plane_supports(const Model& model);

// Displacements given at the end plane x = length by a stretch q (mm) and a rotation theta: u_x = q - theta (y -
// middle).
statics::LoadCase end_displacement(const Model& model, double q, double theta);

// Axial force of nodal forces over the nodes of one end plane, and their moment about its middle.
struct Resultant {
  double force = 0;   // N
  double moment = 0;  // N mm, positive with theta
};
Resultant left_resultant(const Section& section, const std::vector<double>& forces);
Resultant right_resultant(const Section& section, const std::vector<double>& forces);

}  // namespace strandlab::vtest
