// Two blocks on a spring between their centres: the period of two masses on a spring, and momentum.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "strandlab/core/error.hpp"
#include "support/report.hpp"
#include "verification/mpm/single_block.hpp"

namespace strandlab::mpm {
namespace {

constexpr double kE = 10000, kDensity = 500;  // MPa, kg/m^3
constexpr double kMassRatio = 2;              // the second block is twice as long

// Blocks of 2 x 2 mm and 4 x 2 mm that do not reach each other.
std::vector<Body<2>> two_blocks() {
  const auto wood = isotropic(kE, 0.3, kDensity);
  return {block<2>(wood, {8, 8}, {0.25, 0.25}, {0.1, 0.2}), block<2>(wood, {16, 8}, {0.25, 0.25}, {4.15, 1.1})};
}

// From centre to centre: point (n0/2, n1/2) has the centre at its lower left corner.
Spring<2> between_centres(const std::vector<Body<2>>& bodies, const Vec<2>& normal, double stiffness_t,
                          double stiffness_n) {
  const auto centre = [&](int b) {
    const auto& lattice = bodies[b].lattice;
    const auto middle = lattice.point({lattice.counts[0] / 2, lattice.counts[1] / 2});
    return Spring<2>::End{b, static_cast<int>(middle), -0.5 * lattice.spacing};
  };
  return {centre(0), centre(1), normal, 2.0, stiffness_t, stiffness_n};
}

struct Motion {
  double period_s = 0;
  double momentum_change = 0;  // largest, relative to m v of the first block
};

// The first block starts at velocity v; half periods end where the blocks' relative velocity along v passes zero.
Motion oscillate(const Vec<2>& v, const Vec<2>& normal, double stiffness_t, double stiffness_n) {
  auto bodies = two_blocks();
  std::fill(bodies[0].points.v.begin(), bodies[0].points.v.end(), v);
  Engine<2> engine(bodies, open_grid<2>(0.5, -4, 12), {});
  engine.set_springs({between_centres(bodies, normal, stiffness_t, stiffness_n)});
  const Vec<2> start = engine.momentum();
  const auto relative = [&] {
    engine.write(bodies);
    Vec<2> mean[2] = {Vec<2>::Zero(), Vec<2>::Zero()};
    for (int b = 0; b < 2; ++b) {
      for (const auto& u : bodies[b].points.v) mean[b] += u / static_cast<double>(bodies[b].points.size());
    }
    return (mean[0] - mean[1]).dot(v);
  };
  Motion motion;
  std::vector<double> zeros;
  double before = relative();
  while (zeros.size() < 3 && engine.state().step < 20000) {
    const double t = engine.state().time_s;
    engine.step();
    const double now = relative();
    if (before * now < 0) zeros.push_back(t + (engine.state().time_s - t) * before / (before - now));
    before = now;
    motion.momentum_change = std::max(motion.momentum_change, (engine.momentum() - start).norm() / start.norm());
  }
  if (zeros.size() == 3) motion.period_s = zeros[2] - zeros[0];
  return motion;
}

// omega^2 = A k (1/m1 + 1/m2), along the normal with its stiffness, across it with the other. The blocks are 3000 times
// as stiff as the spring, so that their own compliance lengthens the period by less than 0.2 %.
TEST(Spring, SwingsTwoBlocksAtThePeriodOfTwoMasses) {
  const double mass = 4 * kDensity * kTonnePerMm3, area = 2, k = kE / 6000;
  const double exact = 2 * M_PI / std::sqrt(area * k / mass * (1 + 1 / kMassRatio));
  const double amplitude_speed = 0.05 * 2 * M_PI / exact;  // 0.05 mm
  const Vec<2> along(0.8, 0.6), across(-0.6, 0.8);
  const auto normal = oscillate(amplitude_speed * along, along, 0, k);
  const auto tangential = oscillate(amplitude_speed * across, along, k, 0);
  report("two blocks on a spring: period along the normal over 2 pi/sqrt(A k (1/m1 + 1/m2))", normal.period_s / exact,
         near(1, 1e-3));
  report("two blocks on a spring: period across the normal over the same", tangential.period_s / exact, near(1, 1e-3));
  const double change = std::max(normal.momentum_change, tangential.momentum_change);
  report("two blocks on a spring: largest change of momentum over m v", change, below(1e-12).because(test::kRoundOff));
}

// What a spring takes from the blocks' motion it holds: at the turn all kinetic energy of relative motion,
// 1/2 v^2 m1 m2/(m1 + m2).
TEST(Spring, HoldsTheEnergyOfRelativeMotionAtTheTurn) {
  auto bodies = two_blocks();
  const double mass = 4 * kDensity * kTonnePerMm3, v = 1000;
  std::fill(bodies[0].points.v.begin(), bodies[0].points.v.end(), Vec<2>(v, 0));
  Engine<2> engine(bodies, open_grid<2>(0.5, -4, 12), {});
  engine.set_springs({between_centres(bodies, {1, 0}, 0, kE / 6000)});
  double largest = 0;
  while (engine.state().step < 4000) {
    engine.step();
    largest = std::max(largest, engine.spring_energy());
  }
  const double exact = 0.5 * v * v * mass * kMassRatio / (1 + kMassRatio);
  EXPECT_NEAR(largest / exact, 1, 0.01);
  const double kinetic = engine.energies().kinetic;
  engine.scale_velocities(0.5);
  EXPECT_NEAR(engine.energies().kinetic, 0.25 * kinetic, 1e-12 * kinetic);
  engine.scale_velocities(0);
  EXPECT_EQ(engine.energies().kinetic, 0);
}

TEST(Spring, RefusesWhatIsNotThere) {
  const auto bodies = two_blocks();
  Engine<2> engine(bodies, open_grid<2>(0.5, -4, 12), {});
  const auto good = between_centres(bodies, {1, 0}, 1, 1);
  EXPECT_NO_THROW(engine.set_springs({good}));
  auto bad = good;
  bad.b.body = 2;
  EXPECT_THROW(engine.set_springs({bad}), InputError);
  bad = good;
  bad.a.particle = 64;
  EXPECT_THROW(engine.set_springs({bad}), InputError);
  bad = good;
  bad.normal = {1, 1};
  EXPECT_THROW(engine.set_springs({bad}), InputError);
  bad = good;
  bad.stiffness_t = -1;
  EXPECT_THROW(engine.set_springs({bad}), InputError);
}

}  // namespace
}  // namespace strandlab::mpm
