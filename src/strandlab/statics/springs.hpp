// Glue lines as springs between the faces of a mesh.
#pragma once

#include <array>
#include <vector>

#include "strandlab/statics/mesh.hpp"

namespace strandlab::statics {

// One glue point on a mesh: the jump [u] = u_b - u_a along the tangent and the normal as linear forms of eight dofs
// (u_x, u_y of the two nodes on face a, then of the two on face b). The rotation of the two faces times the distance of
// the point's two sides is taken off the jump, so that a rigid rotation stretches nothing even where the glue line has
// a thickness.
struct Spring {
  std::array<int, 4> nodes{};
  Eigen::Matrix<double, 8, 1> tangent, normal;
  double area = 0;  // mm
};

std::vector<Spring> make_springs(const Mesh& mesh, const std::vector<glue::GluePoint<2>>& points);

// Stiffness of a glue line per area, MPa/mm.
struct GlueStiffness {
  double tangential = 0, normal = 0;
};

// Stiffness (N/mm per mm of depth) of a spring in its eight dofs.
ElementStiffness spring_stiffness(const Spring& spring, const GlueStiffness& glue);

}  // namespace strandlab::statics
