// A bonded panel: perfect bonds found by multipliers, others that open.
#include "strandlab/statics/bonded.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace strandlab::statics {
namespace {

// A lap joint of two strands of poplar, 5 mm of overlap.
Panel<2> lap_joint() {
  mat::Mat mat;
  mat.length_mm = 20;
  mat.layer_thickness_mm = 0.8;
  for (const auto& [x0, x1] : {std::pair{0.0, 12.5}, {7.5, 20.0}}) {
    auto& layer = mat.layers.emplace_back();
    layer.role = "surface";
    auto& strand = layer.strands.emplace_back();
    strand.x0_mm = x0;
    strand.x1_mm = x1;
  }
  return make_panel(mat, {{"surface", wood::Material{}, 0}}, 0.8 / 6, 6);
}

struct Pulled {
  double energy = 0, reaction = 0, opening = 0;  // mJ, N, mm
};

// The joint stretched by 0.01 mm, its ends held.
Pulled pull(const glue::Bond& bond, double times) {
  const auto joint = lap_joint();
  const auto mesh = make_mesh(joint, {true, true}, 3);
  BondedPanel panel(mesh, make_springs(mesh, glue::cure(joint, {}), std::vector<bool>(mesh.nodes.size(), false)),
                    penalty(mesh, element_length(joint, 3), times));
  SolveTimes seconds;
  panel.glue(bond, seconds);
  const auto dofs = static_cast<std::size_t>(mesh.dofs());
  Supports supports{std::vector<char>(dofs, 0), 1e4};
  LoadCase load{std::vector<double>(dofs, 0.0), std::vector<double>(dofs, 0.0)};
  std::vector<std::size_t> right;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const double x = mesh.nodes[n][0];
    if (x > 1e-9 && x < 20 - 1e-9) continue;
    supports.fixed[2 * n] = supports.fixed[2 * n + 1] = 1;
    if (x < 1) continue;
    load.given[2 * n] = 0.01;
    right.push_back(2 * n);
  }
  const auto solution = panel.solve(supports, {load}, seconds).front();
  Pulled pulled;
  pulled.energy = panel.energy(solution);
  const auto forces = panel.forces(solution);
  for (const auto dof : right) pulled.reaction += forces[dof];
  for (const auto& jump : panel.jumps(solution)) pulled.opening = std::max(pulled.opening, jump.cwiseAbs().maxCoeff());
  return pulled;
}

// The penalty's springs alone, as a bond of their compliance, leave nine times the opening. Energy and reaction agree,
// U = R u/2, though tractions stand beside the springs.
TEST(BondedPanel, APerfectBondOpensLessThanItsPenalty) {
  const auto joint = lap_joint();
  const double compliance = 1 / penalty(make_mesh(joint, {true, true}, 3), element_length(joint, 3), 10);
  const auto springs = pull({compliance, compliance}, 1e6), perfect = pull({}, 10);
  EXPECT_LT(perfect.opening, 0.2 * springs.opening);
  EXPECT_NEAR(perfect.energy / (0.5 * perfect.reaction * 0.01), 1, 1e-6);
}

// A bond that is not perfect opens by its compliance, and no multiplier takes that away.
TEST(BondedPanel, ACompliantBondOpens) {
  const auto perfect = pull({}, 100), compliant = pull({0.05, 0}, 100);
  EXPECT_LT(compliant.energy, 0.95 * perfect.energy);
  EXPECT_GT(compliant.opening, 1e-2 * 0.01);
  EXPECT_NEAR(compliant.energy / (0.5 * compliant.reaction * 0.01), 1, 1e-9);
}

}  // namespace
}  // namespace strandlab::statics
