// A material point driven by strain increments, as the engine drives it, for tests of both laws.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "strandlab/core/random.hpp"
#include "strandlab/wood/material.hpp"
#include "strandlab/wood/return_map.hpp"
#include "strandlab/wood/yield_modes.hpp"

namespace strandlab::wood {

template <int N>
using Components = Eigen::Matrix<double, N, 1>;
template <int N>
using Matrix = Eigen::Matrix<double, N, N>;

inline constexpr int kAlong = 0, kAcross = 1, kThrough = 2, kThroughShear = 3;  // components 11, 22, 33, 13

// Trial stress, total J, return.
template <int N>
struct Point {
  explicit Point(const StrandMaterial& material)
      : modes(yield_modes<N>(material)), law(material.law()), history(material.start()) {
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j < N; ++j) {
        C(i, j) = material.stiffness(kModeToVoigt[i], kModeToVoigt[j]);
        P(i, j) = material.yield_surface(kModeToVoigt[i], kModeToVoigt[j]);
      }
    }
  }
  double advance(const Components<N>& increment) {
    ln_J += increment[0] + increment[1] + increment[2];
    const Components<N> trial = tau + C * increment;
    double t[N];
    for (int i = 0; i < N; ++i) t[i] = trial[i];
    const double work =
        with_law(law, [&]<class L>() { return return_map<L, ScalarOps, N>(modes, t, J(), history, radius); });
    for (int i = 0; i < N; ++i) tau[i] = t[i];
    return work;
  }
  double J() const { return std::exp(ln_J); }
  double cauchy(int i) const { return tau[i] / J(); }
  bool crushes() const { return law == Law::kCrushing; }
  // Plastic volume ratio since the wood was uncrushed.
  double J_p() const {
    return (1 - modes.laws.crushing.x0) * J() * std::exp(-C.ldlt().solve(tau).template head<3>().sum());
  }
  // Radius of the surface from the definitions of the two laws.
  double hardened() const {
    if (!crushes()) return 1 + modes.laws.hill.K_over_Y * std::pow(history, modes.laws.hill.exponent);
    const auto& k = modes.laws.crushing;
    return 1 + k.h1 * history + k.h2 * std::pow(history / (k.limit - history), k.exponent);
  }
  double f() const { return std::sqrt(tau.dot(P * tau)) / J() - hardened(); }

  YieldModes<N> modes;
  Law law;
  Matrix<N> C, P;
  Components<N> tau = Components<N>::Zero();
  double ln_J = 0, history;  // history: alpha of Hill's law, x of crushing
  double radius = hardened();
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

inline Components<6> random_strain(RandomStream& random, double size) {
  Components<6> e;
  for (int i = 0; i < 6; ++i) e[i] = random.normal();
  return size * e.normalized();
}

// Whether a step yielded, and then: on the surface within 1e-10, backward Euler with associated flow d eps_p = mu P
// tau, work from its definition and positive. mu and q of the flow go to `flow`.
struct FoundFlow {
  double mu = 0, q = 0;
};
inline bool expect_return(const Point<6>& before, const Point<6>& after, const Components<6>& increment, double work,
                          FoundFlow& flow) {
  const Components<6> trial = before.tau + before.C * increment;
  if (work == 0) {
    EXPECT_EQ(after.tau, trial);
    EXPECT_EQ(after.history, before.history);
    EXPECT_LE(after.f(), 1e-10 * after.radius);
    return false;
  }
  EXPECT_LT(std::abs(after.f()), 1e-10 * after.radius);
  EXPECT_NEAR(after.radius, after.hardened(), 1e-12 * after.radius);
  const Components<6> plastic = after.C.ldlt().solve(trial - after.tau);
  const Components<6> direction = after.P * after.tau;
  flow.mu = plastic.dot(direction) / direction.squaredNorm();
  flow.q = std::sqrt(after.tau.dot(direction));
  const double elastic = after.C.ldlt().solve(trial).norm();  // its round-off is left in `plastic`
  EXPECT_LT((plastic - flow.mu * direction).norm(), 1e-9 * plastic.norm() + 1e-14 * (1 + elastic));
  EXPECT_GT(work, 0);
  EXPECT_NEAR(work, after.tau.dot(plastic), 1e-9 * work + 5e-14 * after.tau.norm() * (1 + elastic));
  return true;
}

// -sigma_R under compression through the thickness to each compaction C = 1 - exp(eps_R), in steps of about `step`.
template <class Advance>
std::vector<double> compress(Point<4> point, const std::vector<double>& compactions, double step,
                             const Advance& advance) {
  std::vector<double> stress;
  double strain = 0;
  for (const double C : compactions) {
    const double target = std::log(1 - C);
    const int steps = static_cast<int>(std::ceil((strain - target) / step));
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

}  // namespace strandlab::wood
