// The return map against closed forms and against its own definition: backward Euler with associated flow,
// d eps_p = mu P tau, d alpha = d lambda / Y_R, on the surface f = q/J - (1 + (K/Y_R) alpha^n) = 0 in Kirchhoff stress
// tau = J sigma.
#include "strandlab/wood/return_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "strandlab/core/random.hpp"
#include "strandlab/wood/material.hpp"
#include "strandlab/wood/yield_modes.hpp"

namespace strandlab::wood {
namespace {

template <int N>
using Components = Eigen::Matrix<double, N, 1>;
template <int N>
using Matrix = Eigen::Matrix<double, N, N>;

constexpr int kAlong = 0, kAcross = 1, kThrough = 2, kThroughShear = 3;  // components 11, 22, 33, 13

// A material point driven by strain increments, as the engine does: trial stress, total J, return.
template <int N>
struct Point {
  explicit Point(const StrandMaterial& material) : modes(yield_modes<N>(material)) {
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j < N; ++j) {
        C(i, j) = material.stiffness(kModeToVoigt[i], kModeToVoigt[j]);
        P(i, j) = material.hill(kModeToVoigt[i], kModeToVoigt[j]);
      }
    }
  }
  double advance(const Components<N>& increment) {
    ln_J += increment[0] + increment[1] + increment[2];
    const Components<N> trial = tau + C * increment;
    double t[N];
    for (int i = 0; i < N; ++i) t[i] = trial[i];
    const double work = return_map<ScalarOps, N>(modes, t, J(), alpha, radius);
    for (int i = 0; i < N; ++i) tau[i] = t[i];
    return work;
  }
  double J() const { return std::exp(ln_J); }
  double cauchy(int i) const { return tau[i] / J(); }
  double radius_of_alpha() const { return 1 + modes.K_over_Y * std::pow(alpha, modes.exponent); }
  double f() const { return std::sqrt(tau.dot(P * tau)) / J() - radius_of_alpha(); }

  YieldModes<N> modes;
  Matrix<N> C, P;
  Components<N> tau = Components<N>::Zero();
  double ln_J = 0, alpha = 0, radius = 1;
};

// Advances with the components in `free` at zero stress: their strain increments by Newton's method with differences.
template <int N, std::size_t M>
void advance_free(Point<N>& point, Components<N> increment, const std::array<int, M>& free) {
  const auto stress_after = [&](const Components<N>& e) {
    Point<N> copy = point;
    copy.advance(e);
    Eigen::Matrix<double, M, 1> s;
    for (std::size_t i = 0; i < M; ++i) s[i] = copy.tau[free[i]];
    return s;
  };
  for (int iteration = 0; iteration < 30; ++iteration) {
    const auto s = stress_after(increment);
    if (s.cwiseAbs().maxCoeff() < 1e-10) break;
    Eigen::Matrix<double, M, M> slope;
    for (std::size_t j = 0; j < M; ++j) {
      Components<N> nudged = increment;
      nudged[free[j]] += 1e-9;
      slope.col(j) = (stress_after(nudged) - s) / 1e-9;
    }
    const Eigen::Matrix<double, M, 1> change = slope.fullPivLu().solve(-s);
    for (std::size_t j = 0; j < M; ++j) increment[free[j]] += change[j];
  }
  EXPECT_LT(stress_after(increment).cwiseAbs().maxCoeff(), 1e-8);
  point.advance(increment);
}

StrandMaterial poplar(double angle_deg = 0) {
  return in_strand_axes(library()[0], angle_deg);
}

// Compresses through the thickness to each compaction C = 1 - exp(eps_R) in steps of about 1e-4 and hands over
// -sigma_R.
template <class Advance>
std::vector<double> compress(const std::vector<double>& compactions, const Advance& advance) {
  Point<4> point(poplar());
  std::vector<double> stress;
  double strain = 0;
  for (const double C : compactions) {
    const double target = std::log(1 - C);
    const int steps = static_cast<int>(std::ceil((strain - target) / 1e-4));
    for (int i = 0; i < steps; ++i) {
      Components<4> increment = Components<4>::Zero();
      increment[kThrough] = (target - strain) / steps;
      advance(point, increment);
    }
    strain = target;
    stress.push_back(-point.cauchy(kThrough));
  }
  return stress;
}

void expect_stress(const std::vector<double>& given, const std::vector<double>& expected) {
  ASSERT_EQ(given.size(), expected.size());
  // Table values have three decimals; steps of 1e-4 leave less than 1e-4 of the stress.
  for (std::size_t i = 0; i < given.size(); ++i) EXPECT_NEAR(given[i], expected[i], 0.0006 + 1e-4 * expected[i]) << i;
}

// Unmodified poplar, Y_R = 5, K = 120, n = 4. The tables were integrated independently from the same law.
TEST(HillPath, FreeUniaxialRadialCompression) {
  const auto free = std::array<int, 2>{kAlong, kAcross};
  expect_stress(compress({.1, .2, .3, .4, .5}, [&](auto& point, const auto& e) { advance_free(point, e, free); }),
                {5.012, 5.268, 6.786, 12.343, 28.133});
}

TEST(HillPath, ConfinedRadialCompression) {
  expect_stress(compress({.01, .05, .1, .2, .3, .4}, [](auto& point, const auto& e) { point.advance(e); }),
                {9.700, 33.513, 67.778, 155.804, 281.705, 469.821});
}

TEST(HillPath, ConfinedAcrossFreeAlong) {
  const auto free = std::array<int, 1>{kAlong};
  expect_stress(compress({.01, .05, .1, .2, .3, .4}, [&](auto& point, const auto& e) { advance_free(point, e, free); }),
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
    if (point.alpha == 0) continue;
    const double tau = m.S_RT * (1 + m.hardening_K / m.Y_R * std::pow(point.alpha, 4));
    ASSERT_NEAR(point.tau[component], tau, 1e-9 * tau);
    ASSERT_NEAR(point.alpha, (gamma - tau / m.G_RT) * m.S_RT / m.Y_R, 1e-12);
    for (int k = 0; k < N; ++k) {
      const double other = k == component ? 0 : point.tau[k];
      ASSERT_NEAR(other, 0, 1e-9) << k;
    }
  }
  EXPECT_GT(point.alpha, 0.4);
}

TEST(HillPath, PureShearInTheSection) {
  expect_pure_shear<4>(poplar(90), kThroughShear);
}
TEST(HillPath, PureShearAcross) {
  expect_pure_shear<6>(poplar(0), 4);
}

// Materials whose every stress yields, at angles with all couplings.
std::vector<StrandMaterial> all_kinds() {
  std::vector<StrandMaterial> out;
  for (Material m : library()) {
    for (const double angle : {0.0, 30.0, 90.0}) out.push_back(in_strand_axes(m, angle));
    m.Y_L = 40;
    m.S_RL = 6;
    m.S_TL = 7;
    m.hardening_n = 1;
    out.push_back(in_strand_axes(m, -57));
    m.hardening_n = 2.5;
    m.hardening_K = 0;
    out.push_back(in_strand_axes(m, 12));
  }
  return out;
}

Components<6> random_strain(RandomStream& random, double size) {
  Components<6> e;
  for (int i = 0; i < 6; ++i) e[i] = random.normal();
  return size * e.normalized();
}

// A point with a history: random strains of up to 2 %, compressed or stretched, and some hardening to begin with.
Point<6> random_state(const StrandMaterial& material, RandomStream& random) {
  Point<6> point(material);
  point.ln_J = -1.2 + 1.3 * random.uniform();
  point.alpha = random.uniform() < 0.3 ? 0 : 0.8 * random.uniform();
  point.radius = point.radius_of_alpha();
  for (int i = 0; i < 3; ++i) point.advance(random_strain(random, 0.02));
  return point;
}

// Every strain increment up to 5 %, in any of six dimensions, from any state: on the surface within 1e-10, associated
// flow, work from its definition and positive, hardening as defined.
TEST(ReturnMap, AnyStrainIncrementUpToFivePerCent) {
  RandomStream random(1, 0);
  int yielded = 0;
  for (const auto& material : all_kinds()) {
    for (int trial = 0; trial < 2000; ++trial) {
      Point<6> point = random_state(material, random);
      const Point<6> before = point;
      const Components<6> increment = random_strain(random, 0.05 * random.uniform());
      const double work = point.advance(increment);
      const Components<6> elastic_trial = before.tau + before.C * increment;
      if (point.alpha == before.alpha) {
        EXPECT_EQ(point.tau, elastic_trial);
        EXPECT_EQ(work, 0);
        EXPECT_LE(point.f(), 1e-10 * point.radius);
        continue;
      }
      ++yielded;
      ASSERT_GT(point.alpha, before.alpha);
      ASSERT_LT(std::abs(point.f()), 1e-10 * point.radius);
      ASSERT_NEAR(point.radius, point.radius_of_alpha(), 1e-12 * point.radius);
      const Components<6> plastic = point.C.ldlt().solve(elastic_trial - point.tau);
      const Components<6> flow = point.P * point.tau;  // d eps_p = mu flow
      const double mu = plastic.dot(flow) / flow.squaredNorm();
      const double q = std::sqrt(point.tau.dot(flow));
      ASSERT_LT((plastic - mu * flow).norm(), 1e-9 * plastic.norm() + 1e-14);
      ASSERT_NEAR(point.alpha - before.alpha, mu * q / point.modes.Y, 1e-9 * (point.alpha - before.alpha) + 1e-14);
      ASSERT_GT(work, 0);
      ASSERT_NEAR(work, point.tau.dot(plastic), 1e-9 * work + 1e-12 * point.tau.norm() * 0.05);
    }
  }
  EXPECT_GT(yielded, 10000);
}

// The four components of an aligned strand are the six with the others at zero.
TEST(ReturnMap, FourComponentsAgreeWithSix) {
  RandomStream random(2, 0);
  for (const double angle : {0.0, 90.0}) {
    EXPECT_FALSE(needs_six(poplar(angle)));
    for (int trial = 0; trial < 500; ++trial) {
      Point<4> four(poplar(angle));
      Point<6> six(poplar(angle));
      for (int step = 0; step < 3; ++step) {
        Components<6> e = random_strain(random, 0.03);
        e[4] = e[5] = 0;
        four.advance(e.head<4>());
        six.advance(e);
      }
      ASSERT_LT((four.tau - six.tau.head<4>()).norm(), 1e-9 * six.tau.norm());
      ASSERT_LT(six.tau.tail<2>().norm(), 1e-9 * six.tau.norm());
      ASSERT_NEAR(four.alpha, six.alpha, 1e-11);
    }
  }
  EXPECT_TRUE(needs_six(poplar(45)));
}

// Paths on which the stress keeps its direction: strain along one mode of the simultaneous diagonalisation. One
// backward Euler step of 5 % is then as good as 1000 substeps.
TEST(ReturnMap, OneStepOfFivePerCentEqualsAThousandAlongTheModes) {
  int yielded = 0;
  for (const auto& material : all_kinds()) {
    for (int mode = 0; mode < 6; ++mode) {
      for (const double sign : {-1.0, 1.0}) {
        Point<6> once(material), often(material);
        Components<6> stress;
        for (int i = 0; i < 6; ++i) stress[i] = once.modes.from_modes[i][mode];
        const Components<6> strain = sign * 0.05 * once.C.ldlt().solve(stress).normalized();
        const double work = once.advance(strain);
        double sum = 0;
        for (int i = 0; i < 1000; ++i) sum += often.advance(strain / 1000);
        EXPECT_LT((once.tau - often.tau).norm(), 0.01 * often.tau.norm()) << strain.transpose();
        EXPECT_NEAR(once.alpha, often.alpha, 0.01 * often.alpha) << strain.transpose();
        EXPECT_GE(work, 0);
        EXPECT_GE(sum, 0);
        yielded += often.alpha > 0;
      }
    }
  }
  EXPECT_GT(yielded, 40);
}

// The paths of a pressed strand: through the thickness, confined or free sideways. The stress turns a little as it
// yields; one step of 5 % against 1000.
TEST(ReturnMap, OneStepOfFivePerCentEqualsAThousandUnderCompression) {
  const auto both = [](const Components<4>& strain, auto advance) {
    Point<4> once(poplar()), often(poplar());
    advance(once, strain);
    for (int i = 0; i < 1000; ++i) advance(often, Components<4>(strain / 1000));
    EXPECT_GT(often.alpha, 0);
    EXPECT_LT((once.tau - often.tau).norm(), 0.01 * often.tau.norm()) << strain.transpose();
    EXPECT_NEAR(once.alpha, often.alpha, 0.01 * often.alpha) << strain.transpose();
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
