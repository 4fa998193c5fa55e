#include "strandlab/panel/point_fields.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace strandlab {
namespace {

// A strand that stands at 90 degrees against x, under 7 MPa along its own axis and 3 across: the panel sees the 7 in y.
TEST(PointFields, StressTurnsWithTheStrand) {
  const Tensor<2> upright{{0, -1}, {1, 0}};
  const Voigt tau{7, 3, -2, 0, 0.5, 0};
  const Tensor<3> sigma = cauchy_stress<2>(upright, tau);
  EXPECT_NEAR(sigma(1, 1), 7, 1e-14);
  EXPECT_NEAR(sigma(2, 2), 3, 1e-14);
  EXPECT_NEAR(sigma(0, 0), -2, 1e-14);
  EXPECT_NEAR(sigma(0, 1), -0.5, 1e-14);  // a shear changes sign when turned by 90 degrees
}

// Cauchy = Kirchhoff / J; here the strand is pressed to half its thickness.
TEST(PointFields, StressIsPerCurrentArea) {
  const Tensor<2> pressed{{1, 0}, {0, 0.5}};
  EXPECT_NEAR(cauchy_stress<2>(pressed, Voigt{0, 0, -4, 0, 0, 0})(1, 1), -8, 1e-14);
}

// Turning a state does not change its invariants: trace and norm.
TEST(PointFields, StressKeepsItsInvariantsIn3D) {
  const Tensor<3> F{{0.9, 0.2, 0.1}, {-0.1, 1.1, 0.3}, {0.2, -0.1, 0.8}};
  const Voigt tau{1, 2, 3, 4, 5, 6};
  const Tensor<3> sigma = cauchy_stress<3>(F, tau) * F.determinant();
  EXPECT_NEAR(sigma.trace(), 6, 1e-13);
  EXPECT_NEAR(sigma.squaredNorm(), 1 + 4 + 9 + 2 * (16 + 25 + 36), 1e-12);
  EXPECT_NEAR((strand_axes<3>(F).col(0) - F.col(0).normalized()).norm(), 0, 1e-15);
  EXPECT_NEAR(strand_axes<3>(F).col(2).dot(F.col(1)), 0, 1e-15);
  EXPECT_NEAR(strand_axes<3>(F).determinant(), 1, 1e-14);
  EXPECT_NEAR(strand_axes<2>(Tensor<2>{{1, 0.3}, {0.4, 1}}).determinant(), 1, 1e-14);
}

// The section is the 3D state with x along, z through the thickness, seen with z up as y and y away as -z.
TEST(PointFields, SectionIsTheSameStressIn3D) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  const Tensor<2> F2{{c, -s}, {s, c}};
  const Tensor<3> F3{{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
  const Voigt tau{1, 2, 3, 4, 5, 6};
  const Tensor<3> in2 = cauchy_stress<2>(F2, tau), in3 = cauchy_stress<3>(F3, tau);
  EXPECT_NEAR(in2(0, 0), in3(0, 0), 1e-14);
  EXPECT_NEAR(in2(1, 1), in3(2, 2), 1e-14);
  EXPECT_NEAR(in2(2, 2), in3(1, 1), 1e-14);
  EXPECT_NEAR(in2(0, 1), in3(0, 2), 1e-14);
  EXPECT_NEAR(in2(0, 2), -in3(0, 1), 1e-14);
  EXPECT_NEAR(in2(1, 2), -in3(2, 1), 1e-14);
}

// 0.3 rad of climb, in the plane and in space; a strand pressed to 60 % keeps its mass.
TEST(PointFields, AngleDensityAndThickness) {
  const double degrees = 0.3 * 180 / std::acos(-1.0);
  EXPECT_NEAR(grain_angle_deg<2>(Tensor<2>{{std::cos(0.3), 0}, {std::sin(0.3), 1}}), degrees, 1e-12);
  Tensor<3> F = Tensor<3>::Identity();
  F.col(0) = Vec<3>(0.6 * std::cos(0.3), 0.8 * std::cos(0.3), -std::sin(0.3));
  EXPECT_NEAR(grain_angle_deg<3>(F), -degrees, 1e-12);
  Strand<2> strand;
  strand.material.density = 350 * kTonnePerMm3;
  strand.points.F = {Tensor<2>{{1, 0}, {0.2, 0.6}}};
  EXPECT_NEAR(density_kg_m3(strand, 0), 350 / 0.6, 1e-9);
  EXPECT_NEAR(thickness_strain<2>(strand.points.F[0]), 0.6 / std::hypot(1, 0.2) - 1, 1e-14);
  Tensor<3> pressed = Tensor<3>::Identity();
  pressed(2, 2) = 0.6;
  EXPECT_NEAR(thickness_strain<3>(pressed), -0.4, 1e-14);
}

}  // namespace
}  // namespace strandlab
