// The crushing law: yield at f = H(x), x = 1 - min J_p, on a surface whose pressure yields too; densification.
#include <gtest/gtest.h>

#include <limits>

#include "support/near.hpp"
#include "unit/wood/point.hpp"

namespace strandlab::wood {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Material crushing(const Material& wood = library()[0]) {
  Material m = wood;
  m.law = Law::kCrushing;
  validate(m);
  return m;
}

void expect_stress(const std::vector<double>& given, const std::vector<double>& expected, double half_digit) {
  ASSERT_EQ(given.size(), expected.size());
  for (std::size_t i = 0; i < given.size(); ++i)
    EXPECT_NEAR(given[i], expected[i], half_digit + 1e-4 * expected[i]) << i;
}

const std::vector<double> kCompactions{.1, .2, .3, .4, .5, .6, .65};

// H(x) at 350 kg/m^3, x_L = .7667, to four digits, from the formula by hand.
TEST(CrushingRadius, FollowsTheFormula) {
  const auto& law = in_strand_axes(crushing(), 0).hardening.crushing;
  EXPECT_DOUBLE_EQ(law.limit, 1 - 350.0 / 1500);
  const std::vector<double> expected{1.092, 1.229, 1.432, 1.760, 2.382, 3.943, 5.989};
  const std::vector<double> at{.1, .2, .3, .4, .5, .6, .65};
  for (std::size_t i = 0; i < at.size(); ++i) {
    double slope = 0, ignored = 0;
    EXPECT_NEAR(Crushing::radius<ScalarOps>(law, at[i], slope), expected[i], 0.0005) << at[i];
    const double h = 1e-6, up = Crushing::radius<ScalarOps>(law, at[i] + h, ignored),
                 down = Crushing::radius<ScalarOps>(law, at[i] - h, ignored);
    EXPECT_NEAR(slope, (up - down) / (2 * h), 1e-7 * slope) << at[i];
  }
  double slope = 0;
  EXPECT_EQ(Crushing::radius<ScalarOps>(law, 0.0, slope), 1);
  EXPECT_NEAR(slope, 0.5, 1e-8);  // h1: the power starts flat
  for (const double beyond : {law.limit, law.limit + 1e-9, 0.9}) {
    EXPECT_GT(Crushing::radius<ScalarOps>(law, beyond, slope), 1e14);
    EXPECT_TRUE(std::isfinite(Crushing::radius<ScalarOps>(law, beyond, slope)));
  }
}

// The tables were integrated independently from the same law, Y_R = 3 MPa: three decimals free, two confined.
TEST(CrushingPath, FreeUniaxialRadialCompression) {
  const auto free = std::array<int, 2>{kAlong, kAcross};
  const Point<4> start(in_strand_axes(crushing(), 0));
  expect_stress(compress(start, kCompactions, 1e-3, [&](auto& point, const auto& e) { advance_free(point, e, free); }),
                {3.237, 3.591, 4.100, 4.889, 6.277, 9.314, 12.637}, 0.0006);
}

TEST(CrushingPath, ConfinedRadialCompression) {
  const Point<4> start(in_strand_axes(crushing(), 0));
  expect_stress(compress(start, kCompactions, 1e-4, [](auto& point, const auto& e) { point.advance(e); }),
                {3.29, 3.70, 4.31, 5.30, 7.16, 11.82, 17.87}, 0.005);
}

// A densified strand is the same wood started at x = .615: its first yield in free radial compression is Y_R H(.615),
// and its x_L is that of 350 kg/m^3.
TEST(CrushingPath, DensifiedWoodYieldsWhereItsHistoryLeftIt) {
  const auto material = in_strand_axes(crushing(library()[1]), 0);
  EXPECT_NEAR(material.start(), 0.615, 0.0005);
  EXPECT_NEAR(material.hardening.crushing.limit, 1 - 350.0 / 1500, 1e-15);
  Point<4> point(material);
  EXPECT_NEAR(point.J_p(), 0.3846, 0.00005);
  const double u = .6153846 / (.7666667 - .6153846), H = 1 + .5 * .6153846 + .5 * std::pow(u, 1.3);
  Components<4> increment = Components<4>::Zero();
  increment[kThrough] = -1e-5;
  while (point.history == material.start()) advance_free(point, increment, std::array<int, 2>{kAlong, kAcross});
  EXPECT_NEAR(-point.cauchy(kThrough), 3 * H, 0.003 * H);
}

// c = 1, Y_L infinite and Y_R = Y_T: exactly Hill's function, which knows no change of volume. x stays 0, so that the
// path is that of Hill's law without hardening.
TEST(CrushingLimit, IsHillsFunction) {
  Material hill = library()[0];
  hill.hill.K = 0;
  Material m = hill;
  m.law = Law::kCrushing;
  m.crushing.Y_L = hill.hill.Y_L;
  m.crushing.Y_R = m.crushing.Y_T = hill.hill.Y_R;
  m.crushing.S_RT = hill.hill.S_RT;
  m.crushing.S_RL = hill.hill.S_RL;
  m.crushing.S_TL = hill.hill.S_TL;
  m.crushing.c = 1;
  validate(m);
  RandomStream random(7, 0);
  for (const double angle : {0.0, 35.0, 90.0}) {
    const auto a = in_strand_axes(m, angle), b = in_strand_axes(hill, angle);
    EXPECT_EQ(a.yield_surface, b.yield_surface) << angle;
    Point<6> crushed(a), hilled(b);
    for (int step = 0; step < 50; ++step) {
      const auto e = random_strain(random, 0.02);
      crushed.advance(e);
      hilled.advance(e);
      ASSERT_LT((crushed.tau - hilled.tau).norm(), 1e-9 * hilled.tau.norm()) << step;
      ASSERT_NEAR(crushed.history, 0, 1e-9);
    }
    EXPECT_GT(hilled.history, 0);
  }
}

// Woods that crush, at angles with all couplings, free to shear or held; some whose yield knows no bound along the
// grain.
std::vector<StrandMaterial> crushing_kinds() {
  std::vector<StrandMaterial> out;
  for (const auto& wood : library()) {
    Material m = crushing(wood);
    for (const double angle : {0.0, 30.0, 90.0}) out.push_back(in_strand_axes(m, angle));
    out.push_back(in_strand_axes(m, 45, OffAxis::kUncoupled));
    m.crushing.c = 0;
    m.crushing.Y_L = m.crushing.S_RL = kInfinity;
    out.push_back(in_strand_axes(m, -57));
    m.crushing.c = 0.9;
    m.crushing.exponent = 3;
    m.crushing.h1 = 0;
    out.push_back(in_strand_axes(m, 12));
  }
  return out;
}

// A point with a history: crushed to anywhere short of the limit, perhaps pulled apart since, then random strains of
// 2 %.
Point<6> random_state(const StrandMaterial& material, RandomStream& random) {
  Point<6> point(material);
  const auto& law = material.hardening.crushing;
  point.history = law.limit - (law.limit - law.x0) * random.uniform();
  point.ln_J = std::log((1 - point.history) / (1 - law.x0)) + (random.uniform() < 0.5 ? 0 : 0.3 * random.uniform());
  point.radius = point.hardened();
  for (int i = 0; i < 3; ++i) point.advance(random_strain(random, 0.02));
  return point;
}

// A point on the surface, compressed in a random direction to within 1 to .01 % of the limit: stresses of GPa.
Point<6> dense_state(const StrandMaterial& material, RandomStream& random) {
  Point<6> point(material);
  const auto& law = material.hardening.crushing;
  point.history = law.limit - std::pow(10, -2 - 2 * random.uniform());
  point.radius = point.hardened();
  Components<6> direction = random_strain(random, 1);
  const double volume = point.C.ldlt().solve(direction).head<3>().sum();
  if (volume > 0) direction = -direction;
  const double q = std::sqrt(direction.dot(point.P * direction)), J_p = (1 - point.history) / (1 - law.x0);
  double low = 0, high = J_p * point.radius / q;  // of the stress: q s = J_p J_e(s) radius with J_e <= 1
  for (int i = 0; i < 200; ++i) {
    const double s = 0.5 * (low + high);
    (q * s < J_p * std::exp(-std::abs(volume) * s) * point.radius ? low : high) = s;
  }
  point.tau = low * direction;
  point.ln_J = std::log(J_p) - std::abs(volume) * low;
  return point;
}

// Every strain increment up to 5 %, in any of six dimensions, from any state, also next to the limit where H has no
// bound: on the surface, associated flow, positive work, and x the largest 1 - J_p so far.
TEST(CrushingReturn, AnyStrainIncrementUpToFivePerCent) {
  RandomStream random(3, 0);
  int yielded = 0, dense = 0;
  for (const auto& material : crushing_kinds()) {
    for (int trial = 0; trial < 2000; ++trial) {
      Point<6> point = trial % 4 ? random_state(material, random) : dense_state(material, random);
      const Point<6> before = point;
      const auto increment = random_strain(random, 0.05 * random.uniform());
      const double work = point.advance(increment);
      FoundFlow flow;
      const bool yields = expect_return(before, point, increment, work, flow);
      ASSERT_FALSE(testing::Test::HasFailure()) << trial;
      if (!yields) continue;
      ++yielded;
      dense += point.history > material.hardening.crushing.limit - 0.01;
      ASSERT_LT(point.history, material.hardening.crushing.limit);
      ASSERT_NEAR(point.history, std::max(before.history, 1 - point.J_p()), 1e-12);
    }
  }
  EXPECT_GT(yielded, 10000);
  EXPECT_GT(dense, 1000);
}

// Small steps find H by its series about the x before, to 1e-13: the point returned lies on the surface of the
// definition within that and the 1e-12 at which the return stops, from x = .1 % to 99.5 % of the limit.
TEST(CrushingReturn, SmallStepsEndOnTheSurface) {
  RandomStream random(4, 0);
  int crushed = 0;
  double worst = 0;
  for (const auto& material : crushing_kinds()) {
    for (int trial = 0; trial < 1000; ++trial) {
      Point<6> point(material);
      const auto& law = material.hardening.crushing;
      const double share = std::exp(std::log(1e-3) + random.uniform() * std::log(0.995 / 1e-3));
      point.history = std::max(law.x0, law.limit * share);
      point.ln_J = std::log((1 - point.history) / (1 - law.x0));
      point.radius = point.hardened();
      Components<6> squeeze = -random_strain(random, 1).cwiseAbs();
      point.advance(0.1 * squeeze);  // onto the surface
      for (int i = 0; i < 3; ++i) {
        const double before = point.history;
        const double work = point.advance(std::pow(10, -6 + 3 * random.uniform()) * squeeze);
        crushed += point.history > before;
        if (work > 0) worst = std::max(worst, std::abs(point.f()) / point.radius);
      }
    }
  }
  EXPECT_LT(worst, 2e-12);
  EXPECT_GT(crushed, 10000);
}

// Paths on which the stress keeps its direction, here strain along one mode of the simultaneous diagonalisation: one
// backward Euler step of 5 % is as good as 1000 substeps.
TEST(CrushingReturn, OneStepOfFivePerCentEqualsAThousand) {
  int crushed = 0;
  const auto compare = [&](Point<6> once, const Components<6>& strain) {
    Point<6> often = once;
    const double work = once.advance(strain);
    double sum = 0;
    for (int i = 0; i < 1000; ++i) sum += often.advance(strain / 1000);
    EXPECT_THAT(once.tau, test::VecNear(often.tau, 0.01 * often.tau.norm())) << strain.transpose();
    EXPECT_NEAR(once.history, often.history, 0.01 * often.history + 1e-12) << strain.transpose();
    EXPECT_GE(work, 0);
    EXPECT_GE(sum, 0);
    crushed += often.history > often.modes.laws.crushing.x0;
  };
  for (const auto& material : crushing_kinds()) {
    const Point<6> start(material);
    for (int mode = 0; mode < 6; ++mode) {
      for (const double sign : {-1.0, 1.0}) {
        Components<6> stress;
        for (int i = 0; i < 6; ++i) stress[i] = start.modes.from_modes[i][mode];
        compare(start, sign * 0.05 * start.C.ldlt().solve(stress).normalized());
      }
    }
  }
  EXPECT_GT(crushed, 20);
}

// The same for a strand compressed freely all the way to 60 %, in steps of 5 % of strain.
TEST(CrushingReturn, StepsOfFivePerCentFollowFreeCompression) {
  const auto free = std::array<int, 2>{kAlong, kAcross};
  const auto advance = [&](auto& point, const auto& e) { advance_free(point, e, free); };
  for (const auto& wood : library()) {
    const Point<4> start(in_strand_axes(crushing(wood), 0));
    const double to = wood.name == "vtc" ? 0.1 : 0.6;
    const auto coarse = compress(start, {0.05, to}, 0.05, advance), fine = compress(start, {0.05, to}, 5e-5, advance);
    for (std::size_t i = 0; i < fine.size(); ++i) EXPECT_NEAR(coarse[i], fine[i], 0.01 * fine[i]) << wood.name;
  }
}

// Unloading is elastic, and so is loading again up to where it left the curve; x remembers the densest state.
TEST(CrushingReturn, RemembersTheDensestState) {
  Point<4> point(in_strand_axes(crushing(), 0));
  Components<4> in = Components<4>::Zero();
  in[kThrough] = -0.001;
  for (int i = 0; i < 400; ++i) point.advance(in);
  const auto loaded = point;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(point.advance(-in / 5), 0) << i;
  EXPECT_EQ(point.history, loaded.history);
  for (int i = 0; i < 5; ++i) EXPECT_LT(point.advance(in / 5), 1e-12) << i;
  EXPECT_THAT(point.tau, test::VecNear(loaded.tau, 1e-9 * loaded.tau.norm()));
  EXPECT_NEAR(point.history, 1 - std::exp(-0.4), 0.03);  // nearly all of the compaction is collapse
}

}  // namespace
}  // namespace strandlab::wood
