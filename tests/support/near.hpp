// Matchers for vectors, tensors, stresses and bits that say which component differs and by how much:
//
//   EXPECT_THAT(body.stress[p], VecNear(expected, 1e-9));     // any Eigen matrices of one size
//   EXPECT_THAT(body.stress[p], StressNear(expected, 1e-9));  // the same, components named 11 22 33 23 13 12
//   EXPECT_THAT(a.x, SameBits(b.x));                          // lists of numbers or Eigen matrices
#pragma once

#include <gmock/gmock.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

namespace strandlab::test {

using testing::PrintToString;

inline std::string component_name(Eigen::Index row, Eigen::Index column, Eigen::Index columns) {
  std::ostringstream name;
  if (columns == 1)
    name << '[' << row << ']';
  else
    name << '(' << row << ", " << column << ')';
  return name.str();
}

// Tells of the component that differs most; false if it differs by `tolerance` or more, or is not a number.
template <class A, class B, class Name>
bool all_near(const A& actual, const B& expected, double tolerance, const Name& name,
              testing::MatchResultListener* listener) {
  if (actual.rows() != expected.rows() || actual.cols() != expected.cols()) {
    *listener << "has " << actual.rows() << " x " << actual.cols() << " components, not " << expected.rows() << " x "
              << expected.cols();
    return false;
  }
  double worst = -1;
  Eigen::Index row = 0, column = 0;
  bool near = true;
  for (Eigen::Index j = 0; j < actual.cols(); ++j) {
    for (Eigen::Index i = 0; i < actual.rows(); ++i) {
      const double difference = std::abs(actual(i, j) - expected(i, j));
      near = near && difference < tolerance;
      if (difference <= worst) continue;
      worst = difference;
      row = i;
      column = j;
    }
  }
  *listener << "component " << name(row, column) << " is " << PrintToString(actual(row, column)) << ", expected "
            << PrintToString(expected(row, column)) << ": off by " << worst;
  return near;
}

MATCHER_P2(VecNear, expected, tolerance, "is within " + PrintToString(tolerance) + " in every component") {
  const auto columns = arg.cols();
  return all_near(
      arg, expected, tolerance, [&](auto i, auto j) { return component_name(i, j, columns); }, result_listener);
}

MATCHER_P2(StressNear, expected, tolerance, "is within " + PrintToString(tolerance) + " MPa in every component") {
  constexpr std::array<const char*, 6> kVoigt{"11", "22", "33", "23", "13", "12"};
  return all_near(
      arg, expected, tolerance, [&](auto i, auto) { return std::string(kVoigt[static_cast<std::size_t>(i)]); },
      result_listener);
}

MATCHER_P(SameBits, expected, "has the same bits") {
  if (arg.size() != expected.size()) {
    *result_listener << "has " << arg.size() << " entries, not " << expected.size();
    return false;
  }
  constexpr std::size_t kNumbers = sizeof(arg[0]) / sizeof(double);
  for (std::size_t p = 0; p < arg.size(); ++p) {
    if (std::memcmp(&arg[p], &expected[p], sizeof arg[p]) == 0) continue;
    std::array<double, kNumbers> a, b;
    std::memcpy(a.data(), &arg[p], sizeof a);
    std::memcpy(b.data(), &expected[p], sizeof b);
    for (std::size_t k = 0; k < kNumbers; ++k) {
      if (std::memcmp(&a[k], &b[k], sizeof a[k]) == 0) continue;
      *result_listener << "entry " << p << ", component " << k << " is " << PrintToString(a[k]) << ", expected "
                       << PrintToString(b[k]) << ": off by " << std::abs(a[k] - b[k]);
      return false;
    }
  }
  return true;
}

}  // namespace strandlab::test
