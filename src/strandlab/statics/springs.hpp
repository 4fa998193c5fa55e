// Glue lines as springs between the faces of a mesh.
#pragma once

#include <array>
#include <vector>

#include "strandlab/glue/bond.hpp"
#include "strandlab/statics/mesh.hpp"

namespace strandlab::statics {

// One glue point on a mesh: the jump [u] = u_b - u_a along the tangents and the normal as linear forms of the dofs of
// the nodes around it, the first half of them on side a. The mean rotation of the two sides times their distance is
// taken off the jump, so that a rigid rotation stretches nothing even where the glue line has a thickness.
template <int Dim>
struct Spring {
  std::array<int, kCorners<Dim>> nodes{};
  std::array<ElementDofs<Dim>, Dim> jump;  // along the tangents, then the normal
  double area = 0;                         // mm (2D) or mm^2
  double quality = 1, lacking = 0;         // of the bond (glue/bond.hpp)
  double stiffened = 1;                    // penalty of a perfect bond here over that of its area

  double tangential(const glue::BondStiffness& glue) const {
    return glue.tangential * (glue.perfect_t ? stiffened : 1);
  }
  double normal(const glue::BondStiffness& glue) const { return glue.normal * (glue.perfect_n ? stiffened : 1); }
};

// Springs of the glue points. The rotation is that of the two face segments; at the corner of an end plane (at_end
// holds for the nodes of one) it is that of the plane, which the tests impose: with a prescribed plane the segments'
// own rotation would be locked.
std::vector<Spring<2>> make_springs(const Mesh<2>& mesh, const std::vector<glue::GluePoint<2>>& points,
                                    const std::vector<bool>& at_end);

// The same on a panel; the rotation is that of the normals of the two facets. Displacements may be those beyond a
// plate strain: the plate strain itself moves both sides by what it does in the middle of the glue line. Perfect bonds
// of points at the edges of contacts, which have little area, are as stiff as those of a tenth of an element: else they
// would take their share late, and moduli would depend on the penalty.
std::vector<Spring<3>> make_springs(const Mesh<3>& mesh, const std::vector<glue::GluePoint<3>>& points);

// Stiffness (N/mm, 2D: per mm of depth) of a spring in its dofs.
template <int Dim>
ElementStiffness<Dim> spring_stiffness(const Spring<Dim>& spring, const glue::BondStiffness& glue) {
  const double tangential = spring.tangential(glue), normal = spring.normal(glue);
  ElementStiffness<Dim> k = tangential * spring.jump[0] * spring.jump[0].transpose();
  for (int d = 1; d < Dim - 1; ++d) k += tangential * spring.jump[d] * spring.jump[d].transpose();
  k += normal * spring.jump[Dim - 1] * spring.jump[Dim - 1].transpose();
  return spring.area * k;
}

}  // namespace strandlab::statics
