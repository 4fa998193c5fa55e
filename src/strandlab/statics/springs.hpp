// Glue lines as springs between the faces of a mesh.
#pragma once

#include <array>
#include <vector>

#include "strandlab/glue/bond.hpp"
#include "strandlab/statics/mesh.hpp"

namespace strandlab::statics {

// One glue point on a mesh: the jump [u] = u_b - u_a along the tangent and the normal as linear forms of the eight dofs
// u_x, u_y of four nodes, the first two on side a. The mean rotation of the two sides times their distance is taken off
// the jump, so that a rigid rotation stretches nothing even where the glue line has a thickness.
struct Spring {
  std::array<int, 4> nodes{};
  Eigen::Matrix<double, 8, 1> tangent, normal;
  double area = 0;  // mm
};

// Springs of the glue points. The rotation is that of the two face segments; at the corner of an end plane (at_end
// holds for the nodes of one) it is that of the plane, which the tests impose: with a prescribed plane the segments'
// own rotation would be locked.
std::vector<Spring> make_springs(const Mesh& mesh, const std::vector<glue::GluePoint<2>>& points,
                                 const std::vector<bool>& at_end);

// Stiffness (N/mm per mm of depth) of a spring in its eight dofs.
ElementStiffness spring_stiffness(const Spring& spring, const glue::BondStiffness& glue);

}  // namespace strandlab::statics
