// Bricks with incompatible modes, their answer to plate strains, and their springs.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>

#include "strandlab/core/eigenvalues.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/statics/plate.hpp"
#include "strandlab/wood/material.hpp"
#include "unit/statics/bonds.hpp"

namespace strandlab::statics {
namespace {

using Brick = ElementCorners<3>;

Brick box(double length, double width, double height) {
  Brick x;
  for (int i = 0; i < 8; ++i) {
    x[static_cast<std::size_t>(i)] =
        Vec<3>(i % 4 == 1 || i % 4 == 2 ? length : 0, i % 4 > 1 ? width : 0, i > 3 ? height : 0);
  }
  return x;
}

Brick distorted_brick() {
  auto x = box(1.1, 0.9, 0.5);
  for (std::size_t i = 0; i < 8; ++i) {
    const auto k = static_cast<double>(i);
    x[i] += Vec<3>(0.13 * std::sin(3 * k + 1), 0.11 * std::cos(5 * k), 0.07 * std::sin(7 * k + 2));
  }
  return x;
}

Tensor<3> some_axes() {
  return (Eigen::AngleAxisd(0.4, Vec<3>::UnitZ()) * Eigen::AngleAxisd(0.2, Vec<3>::UnitY())).toRotationMatrix();
}

VoigtMatrix turned_poplar() {
  return in_panel(wood::stiffness(wood::Material{}), some_axes());
}

template <class Field>
ElementDofs<3> sampled(const Brick& corners, const Field& field) {
  ElementDofs<3> u;
  for (int i = 0; i < 8; ++i) u.segment<3>(3 * i) = field(corners[static_cast<std::size_t>(i)]);
  return u;
}

Voigt voigt_strain(const Tensor<3>& e) {
  return (Voigt() << e(0, 0), e(1, 1), e(2, 2), 2 * e(1, 2), 2 * e(0, 2), 2 * e(0, 1)).finished();
}

// The energy of a strain does not care whether strain and strand are turned together; unturned nothing changes.
TEST(InPanel, TurnsWithTheStrand) {
  const VoigtMatrix c = wood::stiffness(wood::Material{});
  EXPECT_LT((in_panel(c, Tensor<3>::Identity()) - c).norm(), 1e-12 * c.norm());
  Tensor<3> strain;
  strain << 0.3, 0.1, -0.05, 0.1, -0.2, 0.07, -0.05, 0.07, 0.15;
  const Tensor<3> turned = some_axes() * strain * some_axes().transpose();
  const Voigt before = voigt_strain(strain), after = voigt_strain(turned);
  EXPECT_NEAR(after.dot(turned_poplar() * after) / before.dot(c * before), 1, 1e-12);
}

TEST(IncompatibleBrick, LetsRigidMotionsPassAndNothingElse) {
  const auto x = distorted_brick();
  const auto k = incompatible_element<3>(x, turned_poplar());
  const double scale = k.diagonal().maxCoeff();
  EXPECT_LT((k - k.transpose()).cwiseAbs().maxCoeff(), 1e-12 * scale);
  for (const auto& axis : {Vec<3>(1, 0, 0), Vec<3>(0, 1, 0), Vec<3>(0, 0, 1)}) {
    EXPECT_LT((k * sampled(x, [&](const Vec<3>&) { return axis; })).norm(), 1e-11 * scale);
    EXPECT_LT((k * sampled(x, [&](const Vec<3>& p) { return axis.cross(p); })).norm(), 1e-11 * scale);
  }
  const auto values = eigenvalues(k);
  EXPECT_LT(std::abs(values[5]), 1e-10 * scale);
  EXPECT_GT(values[6], 1e-5 * scale);
}

// Patch test: a constant strain in a distorted brick stores exactly V/2 e.C e.
TEST(IncompatibleBrick, IsExactForConstantStrain) {
  const auto x = distorted_brick();
  const auto c = turned_poplar();
  Tensor<3> strain;
  strain << 0.01, 0.02, -0.005, 0.02, -0.03, 0.01, -0.005, 0.01, 0.02;
  const Tensor<3> spin = (Tensor<3>() << 0, 0.1, -0.2, -0.1, 0, 0.3, 0.2, -0.3, 0).finished();
  const auto u = sampled(x, [&](const Vec<3>& p) -> Vec<3> { return (strain + spin) * p; });
  const Voigt e = voigt_strain(strain);
  EXPECT_NEAR(0.5 * u.dot(incompatible_element<3>(x, c) * u) / (0.5 * volume(x) * e.dot(c * e)), 1, 1e-11);
}

// A strand bent along its grain, free across: E_L I k^2 L/2 with no shear and no stress across or through, once the
// displacements across and through have found their place.
TEST(IncompatibleBrick, IsExactForPureBendingOfABox) {
  const double length = 2, width = 1.5, height = 0.4, curvature = 0.01;
  const wood::Material poplar;
  const auto x = box(length, width, height);
  const auto k = incompatible_element<3>(x, wood::stiffness(poplar));
  const auto bent = sampled(x, [&](const Vec<3>& p) { return Vec<3>(-curvature * (p[0] - 1) * (p[2] - 0.2), 0, 0); });
  // u_y and u_z are free: eliminated.
  Eigen::Matrix<double, 8, 8> kxx;
  Eigen::Matrix<double, 16, 8> kfx;
  Eigen::Matrix<double, 16, 16> kff;
  const auto free = [](int f) { return 3 * (f / 2) + 1 + f % 2; };
  Eigen::Matrix<double, 8, 1> ux;
  for (int i = 0; i < 8; ++i) {
    ux[i] = bent[3 * i];
    for (int j = 0; j < 8; ++j) kxx(i, j) = k(3 * i, 3 * j);
    for (int f = 0; f < 16; ++f) kfx(f, i) = k(free(f), 3 * i);
  }
  for (int f = 0; f < 16; ++f) {
    for (int g = 0; g < 16; ++g) kff(f, g) = k(free(f), free(g));
  }
  const auto solver = kff.completeOrthogonalDecomposition();  // rigid motions in y and z are left
  const double energy = 0.5 * ux.dot(kxx * ux - kfx.transpose() * solver.solve(kfx * ux));
  EXPECT_NEAR(energy / (0.5 * poplar.E_L * width * std::pow(height, 3) / 12 * curvature * curvature * length), 1,
              1e-11);
}

TEST(IncompatibleBrick, RejectsAnInvertedElement) {
  auto x = box(1, 1, 1);
  std::swap(x[1], x[3]);
  try {
    incompatible_element<3>(x, turned_poplar());
    FAIL();
  } catch (const RunError& error) {
    EXPECT_EQ(std::string(error.what()), "inverted element at x = 0.500 mm, y = 0.500 mm, z = 0.500 mm");
  }
}

// A plate strain is a displacement too, where it is a linear one: what an element stores at given displacements beyond
// it, it stores at their sum without it. Curvatures' displacements are no linear ones: their energy is V/2 k.C k z^2,
// less what incompatible modes take off.
TEST(PlateTerms, AreThoseOfTheDisplacements) {
  const auto x = distorted_brick();
  const auto c = turned_poplar();
  const auto k = incompatible_element<3>(x, c);
  const auto terms = plate_terms(x, c, 0.1);
  const Eigen::Vector3d e(0.01, -0.02, 0.03);
  const auto plate = sampled(
      x, [&](const Vec<3>& p) { return Vec<3>(e[0] * p[0] + 0.5 * e[2] * p[1], e[1] * p[1] + 0.5 * e[2] * p[0], 0); });
  const auto beyond = sampled(x, [](const Vec<3>& p) {
    return Vec<3>(0.01 * std::sin(p[0] + 2 * p[2]), 0.02 * p[1] * p[2], 0.01 * std::cos(p[0] * p[1]));
  });
  PlateStrain p = PlateStrain::Zero();
  p.head<3>() = e;
  const double sum = (plate + beyond).dot(k * (plate + beyond));
  EXPECT_NEAR((beyond.dot(k * beyond) + 2 * beyond.dot(terms.loads * p) + p.dot(terms.own * p)) / sum, 1, 1e-11);
  EXPECT_LT((terms.own - terms.own.transpose()).norm(), 1e-12 * terms.own.norm());
}

// The own stiffness of a box is the integral of C over its height, about the middle: A = h C, B = h z C and, with modes
// that take the strain through the thickness off the bending, D = h (z^2 C + h^2/12 Q) with Q of plane stress.
TEST(PlateTerms, AreTheMomentsOfAPly) {
  auto x = box(2, 1, 0.4);
  for (auto& corner : x) corner[2] += 0.8;
  const VoigtMatrix c = wood::stiffness(wood::Material{});
  const auto own = plate_terms(x, c, 0.5).own;
  const std::array<int, 3> in_plane{0, 1, 5};
  const double volume = 0.8, z = 0.5;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int p = in_plane[static_cast<std::size_t>(i)], q = in_plane[static_cast<std::size_t>(j)];
      const double plane_stress = c(p, q) - c(p, 2) * c(2, q) / c(2, 2);
      EXPECT_NEAR(own(i, j), volume * c(p, q), 1e-8);
      EXPECT_NEAR(own(i, 3 + j), volume * z * c(p, q), 1e-8);
      EXPECT_NEAR(own(3 + i, 3 + j), volume * (z * z * c(p, q) + 0.4 * 0.4 / 12 * plane_stress), 1e-8);
    }
  }
}

// Two strands that cross at 30 degrees, `gap` mm apart.
Panel<3> crossing(double gap) {
  mat::PlateMat mat;
  mat.length_mm = mat.width_mm = 40;
  mat.layer_thickness_mm = 0.8;
  for (const double angle : {0.0, 30.0}) {
    auto& layer = mat.layers.emplace_back();
    layer.role = "surface";
    auto& strand = layer.strands.emplace_back();
    strand.cx_mm = strand.cy_mm = 20;
    strand.length_mm = 24;
    strand.width_mm = 6;
    strand.angle_deg = angle;
  }
  auto panel = make_panel(mat, {{"surface", wood::Material{}, 0}}, 1, 2);
  for (auto& x : panel.strands[1].points.x) x[2] += gap;
  return panel;
}

std::vector<double> at_nodes(const Mesh<3>& mesh, const std::function<Vec<3>(const Vec<3>&)>& field) {
  std::vector<double> u;
  for (const auto& node : mesh.nodes) {
    const Vec<3> at = field(node);
    u.insert(u.end(), at.begin(), at.end());
  }
  return u;
}

// A rigid motion stretches neither wood nor glue, even where the glue line is 0.09 mm thick and facets do not match.
TEST(PanelSprings, DoNotFeelARigidMotion) {
  const auto panel = crossing(0.09);
  const auto mesh = make_mesh(panel, {true, true}, 2, 1);
  const PanelStiffness<3> stiffness(mesh, make_springs(mesh, glue::cure(panel, {})));
  const auto u = at_nodes(
      mesh, [](const Vec<3>& x) -> Vec<3> { return Vec<3>(0.3, -0.2, 0.1) + Vec<3>(1e-3, -2e-3, 3e-3).cross(x); });
  EXPECT_LT(stiffness.glue_energy(u, everywhere(stiffness, {100, 100})), 1e-24);
  EXPECT_NEAR(stiffness.wood_energy(u), 0, 1e-9);
}

// A slip s between two strands in any direction stores D_t s^2/2 times the glued area, 6^2/sin 30 = 72 mm^2, and an
// opening D_n s^2/2.
TEST(PanelSprings, StoreTheEnergyOfAJump) {
  const auto panel = crossing(0);
  const auto mesh = make_mesh(panel, {true, true}, 2, 1);
  const PanelStiffness<3> stiffness(mesh, make_springs(mesh, glue::cure(panel, {})));
  const auto moved = [&](const Vec<3>& by) {
    std::vector<double> u(static_cast<std::size_t>(mesh.dofs()), 0.0);
    for (auto n = static_cast<std::size_t>(mesh.strands[1].first_node); n < mesh.nodes.size(); ++n) {
      for (std::size_t a = 0; a < 3; ++a) u[3 * n + a] = by[static_cast<int>(a)];
    }
    return stiffness.glue_energy(u, everywhere(stiffness, {70, 300}));
  };
  for (const auto& slip : {Vec<3>(0.01, 0, 0), Vec<3>(0, 0.01, 0), Vec<3>(0.006, -0.008, 0)}) {
    EXPECT_NEAR(moved(slip), 0.5 * 70 * 1e-4 * 72, 1e-9);
  }
  EXPECT_NEAR(moved(Vec<3>(0, 0, 0.01)), 0.5 * 300 * 1e-4 * 72, 1e-9);
}

// A strand of 20 x 1 x 1 mm, one element through and across, elements as long as it is thick, clamped at one end and
// pushed at the other: Timoshenko's deflection P L^3/(3 E I) + P L/(5/6 G A); without incompatible modes it would be
// half of it.
TEST(BondedBricks, BendLikeABeam) {
  mat::PlateMat mat;
  mat.length_mm = 20;
  mat.width_mm = 1;
  mat.layer_thickness_mm = 1;
  mat.sides = mat::PlateSides::kCut;
  auto& layer = mat.layers.emplace_back();
  layer.role = "surface";
  auto& strand = layer.strands.emplace_back();
  strand.cx_mm = 10;
  strand.cy_mm = 0.5;
  strand.length_mm = 20;
  strand.width_mm = 1;
  const wood::Material poplar;
  const auto panel = make_panel(mat, {{"surface", poplar, 0}}, 1, 1);
  const auto mesh = make_mesh(panel, {true}, 1, 1);
  BondedPanel<3> bonded(mesh, {}, 1);
  SolveTimes times;
  bonded.glue({}, times);
  const auto dofs = static_cast<std::size_t>(mesh.dofs());
  Supports supports{std::vector<char>(dofs, 0), 1e4};
  LoadCase load{std::vector<double>(dofs, 0.0), std::vector<double>(dofs, 0.0)};
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    if (mesh.nodes[n][0] < 1e-9) supports.fixed[3 * n] = supports.fixed[3 * n + 1] = supports.fixed[3 * n + 2] = 1;
    if (mesh.nodes[n][0] > 20 - 1e-9) load.forces[3 * n + 2] = 0.25;
  }
  const auto solution = bonded.solve(supports, {load}, times).front();
  const double inertia = 1.0 / 12, expected = 8000 / (3 * poplar.E_L * inertia) + 20 / (5.0 / 6 * poplar.G_RL);
  EXPECT_NEAR(2 * bonded.energy(solution) / expected, 1, 5e-3);
}

}  // namespace
}  // namespace strandlab::statics
