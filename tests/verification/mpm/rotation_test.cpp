// Finite rotation: stress and stiffness ride with the strand's axes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <functional>

#include "support/near.hpp"
#include "support/report.hpp"
#include "verification/mpm/single_block.hpp"

namespace strandlab::mpm {
namespace {

constexpr double kDegree = M_PI / 180;

Voigt some_stress(bool in_section) {
  Voigt s;
  s << 30, -4, -7, 2, 5, -3;
  if (in_section) s[3] = s[5] = 0;
  return s;
}

// Carries a pre-stressed block through 360 steps of one degree about its centre and returns the bodies.
template <int Dim>
std::vector<Body<Dim>> turn_once(Body<Dim> body, const Tensor<Dim>& spin) {
  for (auto& s : body.points.stress) s = some_stress(Dim == 2);
  Vec<Dim> centre = Vec<Dim>::Zero();
  for (const auto& x : body.points.x) centre += x / static_cast<double>(body.points.size());
  std::vector<Body<Dim>> bodies{body};
  Engine<Dim> engine(bodies, open_grid<Dim>(1, -12, 20), {});
  const double dt = engine.state().time_step_s;
  const Tensor<Dim> rate = spin * kDegree / dt;
  for (int k = 0; k < 360; ++k) {
    engine.impose(dt, [&](const Vec<Dim>& x) { return Vec<Dim>(rate * (x - centre)); });
  }
  engine.write(bodies);
  return bodies;
}

// A rigid turn of 360 degrees strains nothing: what the strand feels in its own axes is as before to round-off. F is
// exp(dt L) to second order only (advance_F): a step of one degree adds (pi/180)^4/4 of volume, 360 of them 8.4e-6.
template <int Dim>
void expect_unstrained(const std::string& what, const Body<Dim>& body) {
  const Voigt before = some_stress(Dim == 2);
  double stress = 0, volume = 0;
  for (std::size_t p = 0; p < body.points.x.size(); ++p) {
    stress = std::max(stress, (body.points.stress[p] - before).norm() / before.norm());
    volume = std::max(volume, std::abs(body.points.F[p].determinant() - 1));
    ASSERT_LT((body.points.F[p] - Tensor<Dim>::Identity()).norm(), 1e-3);
  }
  report(what + ": relative change of stress in strand axes", stress, below(1e-11).because(test::kRoundOff));
  report(what + ": change of volume", volume, near(360 * std::pow(kDegree, 4) / 4, 3e-10));
}

TEST(ImposedRotation, LeavesStressInStrandAxes2D) {
  Tensor<2> spin;
  spin << 0, -1, 1, 0;
  for (double angle : {0.0, 30.0}) {
    const auto turned = turn_once<2>(block<2>(elastic_poplar(angle), {16, 8}, {0.5, 0.5}, {0.2, 0.3}), spin);
    expect_unstrained<2>(fmt::format("rigid turn of 360 degrees, grain at {} degrees", angle), turned[0]);
  }
}

TEST(ImposedRotation, LeavesStressInStrandAxes3D) {
  const Eigen::Vector3d axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, Eigen::Vector3d(1, 2, 3).normalized()};
  for (const auto& axis : axes) {
    Tensor<3> spin;
    spin << 0, -axis[2], axis[1], axis[2], 0, -axis[0], -axis[1], axis[0], 0;
    const auto turned = turn_once<3>(block<3>(elastic_poplar(30), {8, 6, 4}, {0.5, 0.5, 0.5}, {0.2, 0.3, 0.1}), spin);
    expect_unstrained<3>(
        fmt::format("rigid turn of 360 degrees about ({:.2g}, {:.2g}, {:.2g})", axis[0], axis[1], axis[2]), turned[0]);
  }
}

// ------------------------------------------------------------------------------------------------ free spin

struct Spin {
  double lost = 0;      // of the angular momentum
  double momentum = 0;  // change of linear momentum over mass times largest speed
};

template <int Dim>
double angular_momentum(const Body<Dim>& body) {  // about the centre of mass, in the plane (along, thickness), over m
  Vec<Dim> centre = Vec<Dim>::Zero(), drift = Vec<Dim>::Zero();
  const auto n = static_cast<double>(body.points.size());
  for (std::size_t p = 0; p < body.points.size(); ++p) {
    centre += body.points.x[p] / n;
    drift += body.points.v[p] / n;
  }
  double sum = 0;
  constexpr int y = Dim - 1;
  for (std::size_t p = 0; p < body.points.size(); ++p) {
    const Vec<Dim> x = body.points.x[p] - centre, v = body.points.v[p] - drift;
    sum += x[0] * v[y] - x[y] * v[0];
  }
  return sum;
}

// A poplar block of 8 mm x 4 mm (x 2 mm) in empty space spins by 30 degrees while it flies; its tips move at 1 % of the
// speed of sound along the grain.
template <int Dim>
Spin spin_freely(double cell) {
  std::array<int, Dim> points{};
  constexpr int y = Dim - 1;
  const double size[3] = {8, Dim == 2 ? 4.0 : 2.0, 4};
  for (int a = 0; a < Dim; ++a) points[a] = static_cast<int>(std::lround(2 * size[a] / cell));
  const Vec<Dim> corner = Vec<Dim>::Constant(0.3);
  Body<Dim> body = block<Dim>(elastic_poplar(0), points, Vec<Dim>::Constant(0.5 * cell), corner);
  Vec<Dim> centre = corner;
  for (int a = 0; a < Dim; ++a) centre[a] += 0.5 * size[a];
  const double sound = std::sqrt(body.material.stiffness(0, 0) / body.material.density);
  const double tip = 0.01 * sound, omega = tip / std::hypot(4, 2);
  Vec<Dim> flight = Vec<Dim>::Constant(0.2 * tip);
  for (std::size_t p = 0; p < body.points.size(); ++p) {
    const Vec<Dim> r = body.points.x[p] - centre;
    body.points.v[p] = flight;
    body.points.v[p][0] -= omega * r[y];
    body.points.v[p][y] += omega * r[0];
  }
  std::vector<Body<Dim>> bodies{body};
  Engine<Dim> engine(bodies, open_grid<Dim>(cell, -8, 16), {});
  const Vec<Dim> before = engine.momentum();
  while (engine.state().time_s * omega < 30 * kDegree) engine.step();
  engine.write(bodies);
  Spin result;
  result.lost = 1 - angular_momentum(bodies[0]) / angular_momentum(body);
  result.momentum = (engine.momentum() - before).norm() / (engine.mass() * 1.2 * tip);
  return result;
}

// Nothing acts from outside. Linear momentum is exact; lumping the mass costs angular momentum, less on a finer grid.
template <int Dim>
void expect_free_spin(double coarse, double fine) {
  const Spin a = spin_freely<Dim>(coarse), b = spin_freely<Dim>(fine);
  report(fmt::format("free spin by 30 degrees, {}D, cell {:.2f} mm: angular momentum lost", Dim, coarse), a.lost,
         within(0.03));
  report(fmt::format("free spin by 30 degrees, {}D, cell {:.2f} mm: angular momentum lost", Dim, fine), b.lost,
         within(0.01));
  report(fmt::format("free spin by 30 degrees, {}D: change of linear momentum, relative", Dim),
         std::max(a.momentum, b.momentum), below(1e-12).because(test::kRoundOff));
  EXPECT_LT(std::abs(b.lost), std::abs(a.lost));
}

TEST(FreeSpin, KeepsMomentum2D) {
  expect_free_spin<2>(0.5, 0.25);
}
TEST(FreeSpin, KeepsMomentum3D) {
  expect_free_spin<3>(0.5, 1.0 / 3);
}

// ------------------------------------------------------------------------------------------------ quarter turn

// A block that swings in empty space, lying or turned by a quarter beforehand (about a node, in the plane of the last
// and another axis), grid and all: 300 steps, then turned back.
template <int Dim>
Body<Dim> swing(const Tensor<Dim>& turn) {
  constexpr int y = Dim - 1;
  std::array<int, Dim> points{};
  points.fill(6);
  points[0] = 12;
  Vec<Dim> spacing = Vec<Dim>::Constant(0.5);
  spacing[y] = 0.3;
  Body<Dim> body = block<Dim>(elastic_poplar(30), points, spacing, Vec<Dim>::Constant(0.13));
  const double sound = std::sqrt(body.material.stiffness(0, 0) / body.material.density);
  for (std::size_t p = 0; p < body.points.size(); ++p) {
    const Vec<Dim> x = body.points.x[p];
    Vec<Dim> v = Vec<Dim>::Constant(0.01 * sound);
    v[0] += 0.02 * sound * std::sin(1.3 * x[0] + x[y]);
    v[y] += 0.01 * sound * std::cos(0.7 * x[0]);
    body.points.x[p] = turn * x;
    body.points.v[p] = turn * v;
    body.points.F[p] = turn;
  }
  std::vector<Body<Dim>> bodies{body};
  Engine<Dim> engine(bodies, open_grid<Dim>(1, -20, 20), {});
  for (int k = 0; k < 300; ++k) engine.step();
  engine.write(bodies);
  for (auto& x : bodies[0].points.x) x = turn.transpose() * x;
  return bodies[0];
}

// The grid does not know which way a particle lies: a quarter turn of everything is a quarter turn of the result, to
// round-off. Particles must spread over the nodes as they lie, not by the diagonal of F, which is zero here.
template <int Dim>
void expect_turned(int with) {
  constexpr int y = Dim - 1;
  Tensor<Dim> turn = Tensor<Dim>::Identity();
  turn(with, with) = turn(y, y) = 0;
  turn(with, y) = -1;
  turn(y, with) = 1;
  const auto lying = swing<Dim>(Tensor<Dim>::Identity()), turned = swing<Dim>(turn);
  double worst = 0, stress = 0, largest = 0;
  for (std::size_t p = 0; p < lying.points.size(); ++p) {
    worst = std::max(worst, (turned.points.x[p] - lying.points.x[p]).norm());
    stress = std::max(stress, (turned.points.stress[p] - lying.points.stress[p]).norm());
    largest = std::max(largest, lying.points.stress[p].norm());
  }
  EXPECT_GT(largest, 10) << "MPa";
  report(fmt::format("block turned by a quarter beforehand, {}D, axis {}: difference of stress", Dim, with),
         stress / largest, below(1e-11).because(test::kRoundOff));
  report(fmt::format("block turned by a quarter beforehand, {}D, axis {}: difference of positions", Dim, with), worst,
         below(1e-11).because(test::kRoundOff), "mm");
}

TEST(QuarterTurn, TurnsTheResult2D) {
  expect_turned<2>(0);
}
TEST(QuarterTurn, TurnsTheResult3D) {
  expect_turned<3>(0);
  expect_turned<3>(1);
}

// ------------------------------------------------------------------------------------------------ closed shear cycle

// Shears a block by e_i x e_j: 0 -> 20 -> -20 -> 0 degrees in steps of a tenth of a degree. `peak` sees it at 20
// degrees.
template <int Dim>
Voigt shear_cycle(const wood::StrandMaterial& material, int i, int j, const std::function<void(const Voigt&)>& peak) {
  std::array<int, Dim> points{};
  points.fill(4);
  std::vector<Body<Dim>> bodies{block<Dim>(material, points, Vec<Dim>::Constant(0.5), Vec<Dim>::Constant(0.2))};
  Engine<Dim> engine(bodies, open_grid<Dim>(1, -10, 12), {});
  const double dt = engine.state().time_step_s;
  double shear = 0;
  const auto go_to = [&](double target, int steps) {
    const double rate = (target - shear) / steps / dt;
    for (int k = 0; k < steps; ++k) {
      engine.impose(dt, [&](const Vec<Dim>& x) {
        Vec<Dim> v = Vec<Dim>::Zero();
        v[i] = rate * x[j];
        return v;
      });
    }
    shear = target;
    engine.write(bodies);
  };
  go_to(std::tan(20 * kDegree), 200);
  peak(bodies[0].points.stress[3]);
  go_to(-std::tan(20 * kDegree), 400);
  go_to(0, 200);
  return bodies[0].points.stress[3];
}

// Stress after the cycle against its peak, for every shear of the grid's axes and a grain along and across the shear.
template <int Dim>
void expect_closed() {
  double worst = 0;
  for (double angle : {0.0, 30.0}) {
    for (int i = 0; i < Dim; ++i) {
      for (int j = 0; j < Dim; ++j) {
        if (i == j) continue;
        double largest = 0;
        const Voigt left = shear_cycle<Dim>(elastic_poplar(angle), i, j, [&](const Voigt& s) { largest = s.norm(); });
        EXPECT_GT(largest, 10) << "MPa; shear " << i << j;
        worst = std::max(worst, left.norm() / largest);
      }
    }
  }
  report(fmt::format("closed elastic shear cycle of 20 degrees, {}D: stress left over its peak", Dim), worst,
         below(1e-13).because(test::kRoundOff));
}

TEST(ShearCycle, LeavesNoStress2D) {
  expect_closed<2>();
}
TEST(ShearCycle, LeavesNoStress3D) {
  expect_closed<3>();
}

// With g = tan 20 degrees. Shear along the grain turns no axes: tau_13 = G g. Shear across it turns the grain by atan
// g: it is stretched by sqrt(1 + g^2), the thickness shrinks by as much, and the shear felt is 2 atan g - g (integral
// of cos 2 theta dg).
TEST(ShearCycle, PeaksAtTheClosedForm2D) {
  const auto material = elastic_poplar(0);
  const VoigtMatrix& C = material.stiffness;
  const double g = std::tan(20 * kDegree), stretch = 0.5 * std::log(1 + g * g);
  shear_cycle<2>(material, 0, 1, [&](const Voigt& s) {
    EXPECT_THAT(s, test::StressNear((C(4, 4) * g * Voigt::Unit(4)).eval(), 1e-9 * C(4, 4)));
  });
  shear_cycle<2>(material, 1, 0, [&](const Voigt& s) {
    EXPECT_NEAR(s[4], C(4, 4) * (2 * std::atan(g) - g), 1e-5 * C(4, 4));
    EXPECT_NEAR(s[0], (C(0, 0) - C(0, 2)) * stretch, 1e-5 * C(0, 0));
    EXPECT_NEAR(s[2], (C(2, 0) - C(2, 2)) * stretch, 1e-5 * C(2, 2));
  });
}

}  // namespace
}  // namespace strandlab::mpm
