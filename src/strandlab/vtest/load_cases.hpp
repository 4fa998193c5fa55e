// The load cases of the virtual tests on a meshed panel. Per mm of depth throughout.
#pragma once

#include <vector>

#include "strandlab/statics/stiffness.hpp"
#include "strandlab/vtest/connection.hpp"

namespace strandlab::vtest {

// Nodes of the two end planes, and what the tests need to know of the section.
struct Section {
  double length = 0, thickness = 0, middle = 0;  // mm; middle: height of the mid-plane
  std::vector<int> left, right;                  // nodes
  std::vector<int> pins;                         // one node of each group, held in y where nothing else holds it
  std::vector<Vec<2>> nodes;                     // mm, positions
  double second_moment() const { return thickness * thickness * thickness / 12; }
};
Section make_section(const Panel<2>& panel, const Connection& connection, const statics::Mesh& mesh);

// Nothing held yet.
statics::Supports no_supports(const statics::LowerMatrix& stiffness);
// End planes held in x (tension, end rotation), or the left end clamped (end couple).
statics::Supports end_plane_supports(const Section& section, const statics::LowerMatrix& stiffness);
statics::Supports clamped_supports(const Section& section, const statics::LowerMatrix& stiffness);

// Displacements given at the end plane x = length by a stretch q and a rotation theta: u_x = q - theta (y - middle).
std::vector<double> end_displacement(const Section& section, double q, double theta);

// Axial force of nodal forces over a set of nodes of one end plane, and their moment about its middle.
struct Resultant {
  double force = 0;   // N
  double moment = 0;  // N mm, positive with theta
};
Resultant left_resultant(const Section& section, const std::vector<double>& forces);
Resultant right_resultant(const Section& section, const std::vector<double>& forces);

// Nodal forces of a couple of moment 1 N mm: an even axial traction over the end face of the outermost strand on either
// side that reaches x = length, pulling below and pushing above. Throws InputError if that is one and the same strand.
std::vector<double> couple_forces(const Connection& connection, const statics::Mesh& mesh);

}  // namespace strandlab::vtest
