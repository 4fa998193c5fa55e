#include "strandlab/statics/element.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "strandlab/core/eigenvalues.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/wood/material.hpp"

namespace strandlab::statics {
namespace {

using Dofs = ElementDofs<2>;

const VoigtMatrix& poplar() {
  static const VoigtMatrix c = wood::stiffness(wood::Material{});
  return c;
}

// No parallelogram, whose Jacobian would be the same everywhere.
std::array<Vec<2>, 4> distorted() {
  return {Vec<2>(0, 0), Vec<2>(1.1, 0.1), Vec<2>(0.8, 0.95), Vec<2>(-0.2, 0.7)};
}

template <class Field>
Dofs sample(const std::array<Vec<2>, 4>& corners, Field field) {
  Dofs u;
  for (int i = 0; i < 4; ++i) u.segment<2>(2 * i) = field(corners[i]);
  return u;
}

// Along the grain at 0 degrees the section sees the rows and columns 11, 33 and 13 of the strand's stiffness.
TEST(InSection, TakesThePlaneStrainBlock) {
  const auto c = in_section(poplar(), Vec<2>(1, 0));
  EXPECT_DOUBLE_EQ(c(0, 0), poplar()(0, 0));
  EXPECT_DOUBLE_EQ(c(1, 1), poplar()(2, 2));
  EXPECT_DOUBLE_EQ(c(0, 1), poplar()(0, 2));
  EXPECT_DOUBLE_EQ(c(2, 2), wood::Material{}.G_RL);
  const auto upright = in_section(poplar(), Vec<2>(0, 1));
  EXPECT_NEAR(upright(0, 0), poplar()(2, 2), 1e-9);
  EXPECT_NEAR(upright(1, 1), poplar()(0, 0), 1e-9);
}

// The energy of a strain does not care whether strain and grain are turned together.
TEST(InSection, TurnsWithTheGrain) {
  const double angle = 0.4, c = std::cos(angle), s = std::sin(angle);
  Tensor<2> turn;
  turn << c, -s, s, c;
  Tensor<2> strain;
  strain << 0.3, 0.1, 0.1, -0.2;
  const Tensor<2> turned = turn * strain * turn.transpose();
  const auto voigt = [](const Tensor<2>& e) { return Eigen::Vector3d(e(0, 0), e(1, 1), 2 * e(0, 1)); };
  const double before = voigt(strain).dot(in_section(poplar(), Vec<2>(1, 0)) * voigt(strain));
  const double after = voigt(turned).dot(in_section(poplar(), Vec<2>(c, s)) * voigt(turned));
  EXPECT_NEAR(after / before, 1, 1e-12);
}

TEST(IncompatibleQuadrilateral, LetsRigidMotionsPassAndNothingElse) {
  const auto k = incompatible_element<2>(distorted(), in_section(poplar(), Vec<2>(0.8, 0.6)));
  const double scale = k.diagonal().maxCoeff();
  EXPECT_LT((k - k.transpose()).cwiseAbs().maxCoeff(), 1e-12 * scale);
  EXPECT_LT((k * sample(distorted(), [](const Vec<2>&) { return Vec<2>(1, -2); })).norm(), 1e-12 * scale);
  EXPECT_LT((k * sample(distorted(), [](const Vec<2>& x) { return Vec<2>(-x[1], x[0]); })).norm(), 1e-12 * scale);
  const auto values = eigenvalues(k);
  EXPECT_LT(std::abs(values[2]), 1e-10 * scale);
  EXPECT_GT(values[3], 1e-4 * scale);
}

// Patch test: a constant strain in a distorted element stores exactly area/2 e.C e.
TEST(IncompatibleQuadrilateral, IsExactForConstantStrain) {
  const auto c = in_section(poplar(), Vec<2>(0.8, 0.6));
  const auto k = incompatible_element<2>(distorted(), c);
  const Eigen::Vector3d strain(0.01, -0.02, 0.03);
  const auto u = sample(distorted(), [&](const Vec<2>& x) {
    return Vec<2>(strain[0] * x[0] + 0.5 * strain[2] * x[1], strain[1] * x[1] + 0.5 * strain[2] * x[0]);
  });
  EXPECT_NEAR(0.5 * u.dot(k * u) / (0.5 * area(distorted()) * strain.dot(c * strain)), 1, 1e-12);
}

// Pure bending u_x = -kappa x y of a rectangle stores E' I kappa^2 L/2 with the plane-strain modulus E' = 1/S_11 of the
// section: the element has no parasitic shear.
TEST(IncompatibleQuadrilateral, IsExactForPureBendingOfARectangle) {
  const double length = 0.5, height = 0.25, kappa = 0.01;
  const std::array<Vec<2>, 4> corners{Vec<2>(-length / 2, -height / 2), Vec<2>(length / 2, -height / 2),
                                      Vec<2>(length / 2, height / 2), Vec<2>(-length / 2, height / 2)};
  const auto c = in_section(poplar(), Vec<2>(1, 0));
  const double modulus = c(0, 0) - c(0, 1) * c(0, 1) / c(1, 1);
  EXPECT_NEAR(modulus, 10003.3, 0.1);  // of unmodified poplar
  const auto u = sample(corners, [&](const Vec<2>& x) { return Vec<2>(-kappa * x[0] * x[1], 0); });
  const auto k = incompatible_element<2>(corners, c);
  EXPECT_NEAR(0.5 * u.dot(k * u) / (0.5 * modulus * std::pow(height, 3) / 12 * kappa * kappa * length), 1, 1e-12);
}

TEST(IncompatibleQuadrilateral, RejectsAnInvertedElement) {
  auto corners = distorted();
  std::swap(corners[1], corners[3]);
  EXPECT_THROW(incompatible_element<2>(corners, in_section(poplar(), Vec<2>(1, 0))), RunError);
}

}  // namespace
}  // namespace strandlab::statics
