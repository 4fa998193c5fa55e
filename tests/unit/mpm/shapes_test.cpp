#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "strandlab/mpm/engine.hpp"
#include "strandlab/mpm/gimp.hpp"
#include "support/near.hpp"

namespace strandlab::mpm {
namespace {

// Any position in a cell and any size up to a full cell, and the edges of both ranges.
struct Draw {
  std::mt19937 random{7};
  double offset() {
    const double u = std::uniform_real_distribution<>(-0.55, 0.55)(random);
    return std::clamp(u, -0.5, 0.5);
  }
  double half_width() { return std::clamp(std::uniform_real_distribution<>(-0.05, 0.55)(random), 1e-3, 0.5); }
};

// Tensor products of the one-axis functions over the 3^Dim nodes around a particle, cells of unequal size.
template <int Dim>
void expect_complete() {
  Draw draw;
  for (int trial = 0; trial < 2000; ++trial) {
    std::array<Gimp<double>, Dim> axis;
    Vec<Dim> cell, particle;
    for (int a = 0; a < Dim; ++a) {
      const double d = draw.offset();
      axis[a] = gimp<double>(d, draw.half_width());
      cell[a] = 0.1 + 0.3 * a;
      particle[a] = d * cell[a];
    }
    double unity = 0;
    Vec<Dim> gradient_sum = Vec<Dim>::Zero(), position = Vec<Dim>::Zero();
    Tensor<Dim> identity = Tensor<Dim>::Zero();
    for (int i = 0; i < (Dim == 2 ? 9 : 27); ++i) {
      const std::array<int, 3> node{i % 3, i / 3 % 3, i / 9};
      double w = 1;
      Vec<Dim> g = Vec<Dim>::Ones(), x;
      for (int a = 0; a < Dim; ++a) {
        w *= axis[a].weight[node[a]];
        x[a] = (node[a] - 1) * cell[a];
        for (int b = 0; b < Dim; ++b) g[b] *= a == b ? axis[a].gradient[node[a]] / cell[a] : axis[a].weight[node[a]];
      }
      unity += w;
      gradient_sum += g;
      position += w * x;
      identity += x * g.transpose();
    }
    EXPECT_NEAR(unity, 1, 1e-14);
    EXPECT_LT(gradient_sum.norm() * cell.maxCoeff(), 1e-12);
    EXPECT_LT((position - particle).norm(), 1e-14);
    EXPECT_LT((identity - Tensor<Dim>::Identity()).norm(), 1e-12);
  }
}

// Weights sum to one, gradients to zero, and a field linear in x is met exactly in value and gradient.
TEST(GimpShapeFunctions, AreCompleteToFirstOrderIn2D) {
  expect_complete<2>();
}
TEST(GimpShapeFunctions, AreCompleteToFirstOrderIn3D) {
  expect_complete<3>();
}

// By definition: the mean of the hat function 1 - |x - x_i| over the particle's domain, and of its slope. Midpoint
// rule.
TEST(GimpShapeFunctions, AreMeansOfTheHatFunction) {
  Draw draw;
  for (int trial = 0; trial < 200; ++trial) {
    const double d = draw.offset(), r = draw.half_width();
    const auto s = gimp<double>(d, r);
    constexpr int kPoints = 20000;
    for (int node = -1; node <= 1; ++node) {
      double mean = 0, slope = 0;
      for (int k = 0; k < kPoints; ++k) {
        const double distance = d + r * (2 * (k + 0.5) / kPoints - 1) - node;
        if (std::abs(distance) >= 1) continue;
        mean += 1 - std::abs(distance);
        slope += distance < 0 ? 1 : -1;
      }
      EXPECT_NEAR(s.weight[node + 1], mean / kPoints, 1e-7);
      EXPECT_NEAR(s.gradient[node + 1], slope / kPoints, 1.5 / kPoints);
      EXPECT_GE(s.weight[node + 1], 0);
    }
  }
}

// The engine's own loops meet a linear velocity field exactly too: particles at random places, of random stretch, are
// carried by v = b + A x to x + dt v, and F becomes (I + dt A + dt^2 A^2/2) F.
template <int Dim>
void expect_linear_field() {
  std::mt19937 random(11);
  std::uniform_real_distribution<> unit(0, 1);
  Body<Dim> body;
  body.name = "cloud";
  body.material = wood::in_strand_axes(wood::library()[0], 0);
  body.lattice.spacing = Vec<Dim>::Constant(0.5);
  for (int p = 0; p < 203; ++p) {
    Vec<Dim> x;
    Tensor<Dim> F = Tensor<Dim>::Identity();
    for (int a = 0; a < Dim; ++a) {
      x[a] = 10 * unit(random);
      for (int b = 0; b < Dim; ++b) F(a, b) += 0.6 * (unit(random) - 0.5);
    }
    body.points.x.push_back(x);
    body.points.F.push_back(F);
  }
  body.points.v.assign(body.points.size(), Vec<Dim>::Zero());
  body.points.stress.assign(body.points.size(), Voigt::Zero());
  body.points.plastic.assign(body.points.size(), 0.0);
  Grid<Dim> grid;
  for (int a = 0; a < Dim; ++a) grid.cell[a] = 0.7 + 0.2 * a;
  grid.origin = Vec<Dim>::Constant(0.13);
  grid.lo = Vec<Dim>::Constant(-1);
  grid.hi = Vec<Dim>::Constant(11);
  std::vector<Body<Dim>> bodies{body};
  Engine<Dim> engine(bodies, grid, {});
  Tensor<Dim> A;
  Vec<Dim> b;
  for (int i = 0; i < Dim; ++i) {
    b[i] = unit(random);
    for (int j = 0; j < Dim; ++j) A(i, j) = 0.02 * (unit(random) - 0.5);
  }
  const double dt = 0.5;
  engine.impose(dt, [&](const Vec<Dim>& x) { return Vec<Dim>(b + A * x); });
  engine.write(bodies);
  const Tensor<Dim> step = Tensor<Dim>::Identity() + dt * A + 0.5 * dt * dt * A * A;
  for (std::size_t p = 0; p < body.points.x.size(); ++p) {
    const Vec<Dim> x = body.points.x[p] + dt * (b + A * body.points.x[p]);
    EXPECT_THAT(bodies[0].points.x[p], test::VecNear(x, 1e-13)) << "particle " << p;
    EXPECT_THAT(bodies[0].points.F[p], test::VecNear((step * body.points.F[p]).eval(), 1e-14)) << "particle " << p;
  }
}

TEST(EngineLoops, CarryALinearVelocityFieldExactlyIn2D) {
  expect_linear_field<2>();
}
TEST(EngineLoops, CarryALinearVelocityFieldExactlyIn3D) {
  expect_linear_field<3>();
}

}  // namespace
}  // namespace strandlab::mpm
