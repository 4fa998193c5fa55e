#include "strandlab/mat/angles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "strandlab/core/error.hpp"

namespace strandlab::mat {
namespace {

struct Orientation {
  double mean_abs_deg = 0, rms_deg = 0, cos_2 = 0;
  double mean_abs_error = 0, cos_2_error = 0;  // standard errors of the sample
};

Orientation sample(const AngleDistribution& angles, int count) {
  const AngleSampler sampler(angles);
  RandomStream random(1, 9);
  double absolute = 0, square = 0, cos_2 = 0, cos_2_square = 0;
  for (int i = 0; i < count; ++i) {
    const double deviation = sampler.draw(random) - angles.mean_deg;
    EXPECT_LE(std::abs(deviation), 90.0005);
    const double c = std::cos(2 * deviation * std::numbers::pi / 180);
    absolute += std::abs(deviation) / count;
    square += deviation * deviation / count;
    cos_2 += c / count;
    cos_2_square += c * c / count;
  }
  return {absolute, std::sqrt(square), cos_2, std::sqrt((square - absolute * absolute) / count),
          std::sqrt((cos_2_square - cos_2 * cos_2) / count)};
}

constexpr int kStrands = 200000;

// Of a normal distribution, mean |theta| = sd sqrt(2/pi) and E cos 2 theta = exp(-2 sd^2), the latter also modulo 180
// degrees, which lowers the former of wide ones: 31.238 of 31.915 at sd 40.
TEST(Angles, NormalOnes) {
  for (const auto& [sd, mean_abs] : {std::pair{10.0, 7.979}, {25.0, 19.943}, {40.0, 31.238}}) {
    const auto drawn = sample({17.3, 0, sd}, kStrands);
    EXPECT_NEAR(drawn.mean_abs_deg, mean_abs, 3 * drawn.mean_abs_error) << sd;
    EXPECT_NEAR(drawn.cos_2, std::exp(-2 * std::pow(sd * std::numbers::pi / 180, 2)), 3 * drawn.cos_2_error) << sd;
  }
}

// Von Mises in the doubled angle: E cos 2 theta = I1(kappa)/I0(kappa), here that of normal sd 10, 25 and 40; at kappa
// 1.915 an integral over the density gives mean |theta| 19.72 and a standard deviation of 25.77 degrees.
TEST(Angles, VonMisesOnes) {
  for (const double kappa : {8.736, 1.915, 0.8156}) {
    const auto drawn = sample({-60, 0, 0, kappa}, kStrands);
    EXPECT_NEAR(drawn.cos_2, std::cyl_bessel_i(1, kappa) / std::cyl_bessel_i(0, kappa), 3 * drawn.cos_2_error) << kappa;
  }
  const auto drawn = sample({0, 0, 0, 1.915}, kStrands);
  EXPECT_NEAR(drawn.mean_abs_deg, 19.72, 3 * drawn.mean_abs_error);
  EXPECT_NEAR(drawn.rms_deg, 25.77, 0.15);
}

TEST(Angles, UniformOnesAndOneOnly) {
  const auto drawn = sample({0, 90}, kStrands);
  EXPECT_NEAR(drawn.mean_abs_deg, 45, 3 * drawn.mean_abs_error);
  EXPECT_NEAR(drawn.cos_2, 0, 3 * drawn.cos_2_error);
  RandomStream random(1, 1);
  EXPECT_EQ(AngleSampler({12.5}).draw(random), 12.5);
}

// The most concentrated and the widest have no angle that is not a number, whatever is drawn.
TEST(Angles, LimitsOfTheirRange) {
  const auto narrow = sample({0, 0, 0, kMostConcentrated}, kStrands);
  EXPECT_NEAR(narrow.rms_deg, 180 / std::numbers::pi / (2 * std::sqrt(kMostConcentrated)), 0.01);
  const auto wide = sample({0, 0, 0, 1e-9}, kStrands);
  EXPECT_NEAR(wide.mean_abs_deg, 45, 3 * wide.mean_abs_error);
  EXPECT_NEAR(sample({0, 0, 90}, kStrands).mean_abs_deg, 45, 0.6);  // normal, modulo 180 degrees nearly uniform
}

// FNV-1a over many angles: no compiler, flag or machine may move one.
TEST(Angles, SameOnEveryMachine) {
  std::uint64_t hash = 14695981039346656037U;
  for (const auto& angles : {AngleDistribution{0, 90}, {90, 0, 25}, {0, 0, 0, 1.915}}) {
    const AngleSampler sampler(angles);
    RandomStream random(1, 2);
    for (int i = 0; i < 10000; ++i) {
      for (const char digit : std::to_string(std::llround(1000 * sampler.draw(random))) + ",")
        hash = (hash ^ static_cast<unsigned char>(digit)) * 1099511628211U;
    }
  }
  EXPECT_EQ(hash, 18317748564074365795U);
}

TEST(Angles, BadOnesAreNamed) {
  const auto told = [](const AngleDistribution& angles) -> std::string {
    try {
      check(angles, "row 3");
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(told({0, 0, 91}), "row 3: standard deviation of the angle = 91 must be between 0 and 90 degrees");
  EXPECT_EQ(told({0, 0, 0, -1}), "row 3: kappa of the angle = -1 must be between 0 and 300");
  EXPECT_EQ(told({0, 10, 25}),
            "row 3: angle spread = 10, standard deviation = 25 and kappa = 0: strands have one distribution of angles");
  EXPECT_NE(told({0, 0, std::nan("")}), "accepted");
}

}  // namespace
}  // namespace strandlab::mat
