#include "strandlab/statics/cholesky.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/statics/stiffness.hpp"

namespace strandlab::statics {
namespace {

// Chain of n unit springs held at the left: the matrix of -u'' on n points, last one free.
LowerMatrix chain(int n) {
  LowerMatrix a;
  a.column_start = {0};
  for (int j = 0; j < n; ++j) {
    a.row.push_back(j);
    a.value.push_back(j + 1 < n ? 2 : 1);
    if (j + 1 < n) {
      a.row.push_back(j + 1);
      a.value.push_back(-1);
    }
    a.column_start.push_back(static_cast<int>(a.row.size()));
  }
  return a;
}

TEST(Cholesky, MultipliesWithTheWholeSymmetricMatrix) {
  EXPECT_EQ(multiply(chain(3), {1, 2, 4}), (std::vector<double>{0, -1, 2}));
}

// A unit force at the free end moves link i by i + 1.
TEST(Cholesky, SolvesAChainOfSprings) {
  const int n = 500;
  const auto a = chain(n);
  Cholesky cholesky(a);
  cholesky.factorise(a);
  std::vector<double> force(n, 0.0);
  force.back() = 1;
  const auto u = cholesky.solve(force);
  for (int i = 0; i < n; ++i) EXPECT_NEAR(u[i], i + 1, 1e-9);
}

// A matrix with the same pattern is factorised again without a new analysis.
TEST(Cholesky, RefactorisesTheSamePattern) {
  auto a = chain(50);
  Cholesky cholesky(a);
  for (const double factor : {1.0, 4.0}) {
    auto scaled = a;
    for (double& v : scaled.value) v *= factor;
    cholesky.factorise(scaled);
    std::vector<double> force(50, 0.0);
    force.back() = 1;
    EXPECT_NEAR(cholesky.solve(force).back(), 50 / factor, 1e-10);
  }
}

TEST(Cholesky, SaysWhenAMatrixIsNotPositiveDefinite) {
  auto a = chain(20);
  for (double& v : a.value) v = -v;
  Cholesky cholesky(a);
  EXPECT_THROW(cholesky.factorise(a), RunError);
}

// Chain held at both ends, last link pulled to 1: evenly spaced, the forces of the unconstrained matrix are the
// reactions.
TEST(Supports, ImposeDisplacements) {
  const int n = 10;
  const auto a = chain(n);
  Supports supports;
  supports.fixed.assign(n, 0);
  supports.fixed.back() = 1;
  supports.diagonal = 3;
  std::vector<double> given(n, 0.0);
  given.back() = 1;
  const auto matrix = constrained(a, supports);
  Cholesky cholesky(matrix);
  cholesky.factorise(matrix);
  const auto u = cholesky.solve(right_hand_side(a, supports, std::vector<double>(n, 0.0), given));
  for (int i = 0; i < n; ++i) EXPECT_NEAR(u[i], (i + 1) / 10.0, 1e-13);
  EXPECT_NEAR(multiply(a, u).back(), 0.1, 1e-13);
}

}  // namespace
}  // namespace strandlab::statics
