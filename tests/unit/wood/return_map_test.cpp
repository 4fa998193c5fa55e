// The return map against closed forms and against its own definition: backward Euler with associated flow,
// d eps_p = mu P tau, d alpha = d lambda / Y_R, on the surface f = q/J - (1 + (K/Y_R) alpha^n) = 0 in Kirchhoff stress
// tau = J sigma.
#include "strandlab/wood/return_map.hpp"

#include <gtest/gtest.h>

#include "support/near.hpp"
#include "unit/wood/point.hpp"

namespace strandlab::wood {
namespace {

StrandMaterial poplar_at(double angle_deg) {
  return in_strand_axes(library()[0], angle_deg);
}

void expect_stress(const std::vector<double>& given, const std::vector<double>& expected) {
  ASSERT_EQ(given.size(), expected.size());
  // Table values have three decimals; steps of 1e-4 leave less than 1e-4 of the stress.
  for (std::size_t i = 0; i < given.size(); ++i) EXPECT_NEAR(given[i], expected[i], 0.0006 + 1e-4 * expected[i]) << i;
}

// Unmodified poplar, Y_R = 5, K = 120, n = 4. The tables were integrated independently from the same law.
TEST(HillPath, FreeUniaxialRadialCompression) {
  const auto free = std::array<int, 2>{kAlong, kAcross};
  expect_stress(compress(Point<4>(poplar_at(0)), {.1, .2, .3, .4, .5}, 1e-4,
                         [&](auto& point, const auto& e) { advance_free(point, e, free); }),
                {5.012, 5.268, 6.786, 12.343, 28.133});
}

TEST(HillPath, ConfinedRadialCompression) {
  expect_stress(compress(Point<4>(poplar_at(0)), {.01, .05, .1, .2, .3, .4}, 1e-4,
                         [](auto& point, const auto& e) { point.advance(e); }),
                {9.700, 33.513, 67.778, 155.804, 281.705, 469.821});
}

TEST(HillPath, ConfinedAcrossFreeAlong) {
  const auto free = std::array<int, 1>{kAlong};
  expect_stress(compress(Point<4>(poplar_at(0)), {.01, .05, .1, .2, .3, .4}, 1e-4,
                         [&](auto& point, const auto& e) { advance_free(point, e, free); }),
                {9.518, 32.656, 65.836, 150.579, 270.838, 449.050});
}

// tau = S_RT (1 + (K/Y_R) alpha^n) with alpha from the plastic shear: d gamma_p = d lambda/S_RT, so alpha = gamma_p
// S_RT/Y_R and gamma = tau/G_RT + gamma_p. Pure shear keeps J = 1. A core strand has RT shear in the section (4
// components); a surface strand has it across (component 23 of six).
template <int N>
void expect_pure_shear(const StrandMaterial& material, int component) {
  const auto& m = library()[0];
  Point<N> point(material);
  double gamma = 0;
  for (int i = 0; i < 2000; ++i) {
    Components<N> increment = Components<N>::Zero();
    increment[component] = 5e-4;
    gamma += 5e-4;
    point.advance(increment);
    if (point.history == 0) continue;
    const double tau = m.hill.S_RT * (1 + m.hill.K / m.hill.Y_R * std::pow(point.history, 4));
    ASSERT_NEAR(point.tau[component], tau, 1e-9 * tau);
    ASSERT_NEAR(point.history, (gamma - tau / m.G_RT) * m.hill.S_RT / m.hill.Y_R, 1e-12);
    for (int k = 0; k < N; ++k) {
      const double other = k == component ? 0 : point.tau[k];
      ASSERT_NEAR(other, 0, 1e-9) << k;
    }
  }
  EXPECT_GT(point.history, 0.4);
}

TEST(HillPath, PureShearInTheSection) {
  expect_pure_shear<4>(poplar_at(90), kThroughShear);
}
TEST(HillPath, PureShearAcross) {
  expect_pure_shear<6>(poplar_at(0), 4);
}

// Materials whose every stress yields, at angles with all couplings.
std::vector<StrandMaterial> hill_kinds() {
  std::vector<StrandMaterial> out;
  for (Material m : library()) {
    for (const double angle : {0.0, 30.0, 90.0}) out.push_back(in_strand_axes(m, angle));
    m.hill.Y_L = 40;
    m.hill.S_RL = 6;
    m.hill.S_TL = 7;
    m.hill.n = 1;
    out.push_back(in_strand_axes(m, -57));
    m.hill.n = 2.5;
    m.hill.K = 0;
    out.push_back(in_strand_axes(m, 12));
  }
  return out;
}

// Components (11, 22, 33, 13, 23, 12) as a tensor and back; shears count `shear` times.
Tensor<3> tensor(const Components<6>& a, double shear) {
  Tensor<3> m;
  m << a[0], shear * a[5], shear * a[3], shear * a[5], a[1], shear * a[4], shear * a[3], shear * a[4], a[2];
  return m;
}
Components<6> components(const Tensor<3>& m, double shear) {
  Components<6> a;
  a << m(0, 0), m(1, 1), m(2, 2), shear * m(0, 2), shear * m(1, 2), shear * m(0, 1);
  return a;
}

// A point with a history: random strains of up to 2 %, compressed or stretched, and some hardening to begin with.
Point<6> hill_state(const StrandMaterial& material, RandomStream& random) {
  Point<6> point(material);
  point.ln_J = -1.2 + 1.3 * random.uniform();
  point.history = random.uniform() < 0.3 ? 0 : 0.8 * random.uniform();
  point.radius = point.hardened();
  for (int i = 0; i < 3; ++i) point.advance(random_strain(random, 0.02));
  return point;
}

// Every strain increment up to 5 %, in any of six dimensions, from any state: on the surface within 1e-10, associated
// flow, work from its definition and positive, hardening as defined.
TEST(ReturnMap, AnyStrainIncrementUpToFivePerCent) {
  RandomStream random(1, 0);
  int yielded = 0;
  for (const auto& material : hill_kinds()) {
    for (int trial = 0; trial < 2000; ++trial) {
      Point<6> point = hill_state(material, random);
      const Point<6> before = point;
      const Components<6> increment = random_strain(random, 0.05 * random.uniform());
      const double work = point.advance(increment);
      FoundFlow flow;
      const bool yields = expect_return(before, point, increment, work, flow);
      ASSERT_FALSE(testing::Test::HasFailure());
      if (!yields) continue;
      ++yielded;
      const double growth = point.history - before.history;
      ASSERT_GT(growth, 0);
      ASSERT_NEAR(growth, flow.mu * flow.q * point.modes.laws.hill.inverse_Y, 1e-9 * growth + 1e-14);
    }
  }
  EXPECT_GT(yielded, 10000);
}

// Yielding does not depend on the axes: a strand at an angle under the strain turned by that angle follows the aligned
// strand, with either law.
TEST(ReturnMap, IsInvariantUnderTheStrandAngle) {
  RandomStream random(5, 0);
  for (const Law law : {Law::kHill, Law::kCrushing}) {
    Material m = library()[0];
    m.law = law;
    m.hill.Y_L = 40;
    m.hill.S_RL = 6;
    m.hill.S_TL = 7;
    for (const double angle : {-70.0, 15.0, 45.0}) {
      const double t = angle * M_PI / 180;
      Tensor<3> turn;  // columns: wood axes in strand axes
      turn << std::cos(t), -std::sin(t), 0, std::sin(t), std::cos(t), 0, 0, 0, 1;
      Point<6> along(in_strand_axes(m, 0)), turned(in_strand_axes(m, angle));
      for (int step = 0; step < 100; ++step) {
        const auto e = random_strain(random, 0.01);
        along.advance(e);
        turned.advance(components(turn * tensor(e, 0.5) * turn.transpose(), 2));
        const Components<6> expected = components(turn * tensor(along.tau, 1) * turn.transpose(), 1);
        ASSERT_LT((turned.tau - expected).norm(), 1e-9 * expected.norm()) << name(law) << ", " << angle;
        ASSERT_NEAR(turned.history, along.history, 1e-10);
      }
      EXPECT_GT(along.history, 0.001);
    }
  }
}

// The four components of an aligned strand are the six with the others at zero.
TEST(ReturnMap, FourComponentsAgreeWithSix) {
  RandomStream random(2, 0);
  for (const double angle : {0.0, 90.0}) {
    EXPECT_FALSE(needs_six(poplar_at(angle)));
    for (int trial = 0; trial < 500; ++trial) {
      Point<4> four(poplar_at(angle));
      Point<6> six(poplar_at(angle));
      for (int step = 0; step < 3; ++step) {
        Components<6> e = random_strain(random, 0.03);
        e[4] = e[5] = 0;
        four.advance(e.head<4>());
        six.advance(e);
      }
      ASSERT_LT((four.tau - six.tau.head<4>()).norm(), 1e-9 * six.tau.norm());
      ASSERT_LT(six.tau.tail<2>().norm(), 1e-9 * six.tau.norm());
      ASSERT_NEAR(four.history, six.history, 1e-11);
    }
  }
  EXPECT_TRUE(needs_six(poplar_at(45)));
}

// Paths on which the stress keeps its direction: strain along one mode of the simultaneous diagonalisation. One
// backward Euler step of 5 % is then as good as 1000 substeps.
TEST(ReturnMap, OneStepOfFivePerCentEqualsAThousandAlongTheModes) {
  int yielded = 0;
  for (const auto& material : hill_kinds()) {
    for (int mode = 0; mode < 6; ++mode) {
      for (const double sign : {-1.0, 1.0}) {
        Point<6> once(material), often(material);
        Components<6> stress;
        for (int i = 0; i < 6; ++i) stress[i] = once.modes.from_modes[i][mode];
        const Components<6> strain = sign * 0.05 * once.C.ldlt().solve(stress).normalized();
        const double work = once.advance(strain);
        double sum = 0;
        for (int i = 0; i < 1000; ++i) sum += often.advance(strain / 1000);
        EXPECT_THAT(once.tau, test::VecNear(often.tau, 0.01 * often.tau.norm())) << strain.transpose();
        EXPECT_NEAR(once.history, often.history, 0.01 * often.history) << strain.transpose();
        EXPECT_GE(work, 0);
        EXPECT_GE(sum, 0);
        yielded += often.history > 0;
      }
    }
  }
  EXPECT_GT(yielded, 40);
}

// The paths of a pressed strand: through the thickness, confined or free sideways. The stress turns a little as it
// yields; one step of 5 % against 1000.
TEST(ReturnMap, OneStepOfFivePerCentEqualsAThousandUnderCompression) {
  const auto both = [](const Components<4>& strain, auto advance) {
    Point<4> once(poplar_at(0)), often(poplar_at(0));
    advance(once, strain);
    for (int i = 0; i < 1000; ++i) advance(often, Components<4>(strain / 1000));
    EXPECT_GT(often.history, 0);
    EXPECT_THAT(once.tau, test::VecNear(often.tau, 0.01 * often.tau.norm())) << strain.transpose();
    EXPECT_NEAR(once.history, often.history, 0.01 * often.history) << strain.transpose();
  };
  const auto free2 = std::array<int, 2>{kAlong, kAcross};
  const auto free1 = std::array<int, 1>{kAlong};
  for (const double sign : {-1.0, 1.0}) {
    Components<4> radial = Components<4>::Zero();
    radial[kThrough] = 0.05 * sign;
    both(radial, [](auto& point, const auto& e) { point.advance(e); });
    both(radial, [&](auto& point, const auto& e) { advance_free(point, e, free2); });
    both(radial, [&](auto& point, const auto& e) { advance_free(point, e, free1); });
  }
}

}  // namespace
}  // namespace strandlab::wood
