#include "strandlab/core/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "strandlab/core/random.hpp"

namespace strandlab {
namespace {

// How many doubles lie between a number and the value of greater precision that it stands for.
double units_in_last_place(double value, long double exact) {
  const double nearest = static_cast<double>(exact);
  const double step = std::nextafter(std::abs(nearest), INFINITY) - std::abs(nearest);
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact) / step);
}

// The C library's functions of 80-bit numbers, a thousand times as precise, say what the values are.
TEST(Elementary, CosineAndSineWithinTwoUnitsInTheLastPlace) {
  double worst = 0;
  RandomStream random(1, 1);
  for (int i = 0; i < 200000; ++i) {
    const double angle = i < 100000 ? -180 + 0.0036 * i : 720 * (random.uniform() - 0.5);
    const auto value = cos_sin_degrees(angle);
    int quarters = 0;  // taken off first: near a quarter turn the error of an 80-bit pi would show
    const long double rest = std::remquo(angle, 90.0, &quarters) * (std::numbers::pi_v<long double> / 180);
    const bool odd = quarters & 1, half_turn = quarters & 2;
    const long double cos = odd ? -std::sin(rest) : std::cos(rest), sin = odd ? std::cos(rest) : std::sin(rest);
    worst = std::max(worst, units_in_last_place(value.cos, half_turn ? -cos : cos));
    worst = std::max(worst, units_in_last_place(value.sin, half_turn ? -sin : sin));
    ASSERT_NEAR(value.cos * value.cos + value.sin * value.sin, 1, 4e-16) << angle;
  }
  EXPECT_LT(worst, 2);
}

TEST(Elementary, QuarterTurnsAreExact) {
  for (int quarter = -9; quarter <= 9; ++quarter) {
    const auto value = cos_sin_degrees(90.0 * quarter);
    const int turn = ((quarter % 4) + 4) % 4;
    EXPECT_EQ(value.cos, turn == 0 ? 1 : turn == 2 ? -1 : 0) << quarter;
    EXPECT_EQ(value.sin, turn == 1 ? 1 : turn == 3 ? -1 : 0) << quarter;
  }
}

TEST(Elementary, ExponentialAndLogarithm) {
  double worst_exp = 0, worst_log = 0;
  RandomStream random(1, 2);
  for (int i = 0; i < 100000; ++i) {
    const double x = (i % 2 ? 1400 : 4) * (random.uniform() - 0.5);
    worst_exp = std::max(worst_exp, units_in_last_place(portable_exp(x), std::exp(static_cast<long double>(x))));
    const double y = std::ldexp(random.uniform(), i % 40 - 20);
    const long double exact = std::log(static_cast<long double>(y));
    worst_log =
        std::max(worst_log, static_cast<double>(std::abs(portable_log(y) - exact) / std::max(1.0L, std::abs(exact))));
  }
  EXPECT_LT(worst_exp, 2);
  EXPECT_LT(worst_log, 4e-16);
  EXPECT_EQ(portable_exp(0), 1);
  EXPECT_EQ(portable_log(1), 0);
}

// FNV-1a over the bits of many values: no compiler, flag or machine may move one.
TEST(Elementary, SameBitsOnEveryMachine) {
  std::uint64_t hash = 14695981039346656037U;
  const auto add = [&hash](double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    for (int byte = 0; byte < 8; ++byte) hash = (hash ^ (bits >> 8 * byte & 0xff)) * 1099511628211U;
  };
  for (int i = 0; i < 20000; ++i) {
    const auto value = cos_sin_degrees(0.018 * i - 180);
    add(value.cos);
    add(value.sin);
    add(portable_exp(0.001 * i - 10));
    add(portable_log(0.001 * (i + 1)));
  }
  EXPECT_EQ(hash, 10537774872312535200U);
}

}  // namespace
}  // namespace strandlab
