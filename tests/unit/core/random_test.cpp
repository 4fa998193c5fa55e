#include "strandlab/core/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace strandlab {
namespace {

using Counter = std::array<std::uint32_t, 4>;

// Known answers of the authors' Random123 library (file kat_vectors, "philox4x32 10").
TEST(Philox, KnownAnswersOfRandom123) {
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}), (Counter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox4x32({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (Counter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Counter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

// The stream is the generator's blocks in order, low words first: the first known answer of Random123 again.
TEST(RandomStream, WalksTheCounter) {
  RandomStream stream(0, 0);
  EXPECT_EQ(stream.bits(), 0xe169c58d6627e8d5U);
  EXPECT_EQ(stream.bits(), 0x9b00dbd8bc57ac4cU);
  const auto second = philox4x32({1, 0, 0, 0}, {0, 0});
  EXPECT_EQ(stream.bits(), second[0] | std::uint64_t{second[1]} << 32);
}

TEST(RandomStream, SeedsAndStreamsDiffer) {
  EXPECT_NE(RandomStream(1, 0).bits(), RandomStream(0, 1).bits());
  EXPECT_NE(RandomStream(1, 0).bits(), RandomStream(std::uint64_t{1} << 32, 0).bits());
  EXPECT_NE(RandomStream(0, 1).bits(), RandomStream(0, std::uint64_t{1} << 32).bits());
  EXPECT_EQ(RandomStream(7, 3).bits(), RandomStream(7, 3).bits());
}

// 200 cells of a uniform sample: chi-square has 199 degrees of freedom, sd sqrt(2 199) = 20; 5 sd allowed.
TEST(RandomStream, UniformIsFlatAndOpen) {
  RandomStream stream(11, 2);
  constexpr int kCells = 200, kDraws = 400000;
  std::vector<int> count(kCells, 0);
  for (int i = 0; i < kDraws; ++i) {
    const double u = stream.uniform();
    ASSERT_GT(u, 0);
    ASSERT_LT(u, 1);
    ++count[static_cast<std::size_t>(u * kCells)];
  }
  const double expected = static_cast<double>(kDraws) / kCells;
  double chi2 = 0;
  for (const int n : count) chi2 += (n - expected) * (n - expected) / expected;
  EXPECT_LT(std::abs(chi2 - (kCells - 1)), 5 * std::sqrt(2.0 * (kCells - 1)));
}

// The quantile undoes the distribution function Phi(z) = erfc(-z/sqrt 2)/2 of the C library. Phi itself is
// ill-conditioned in the tails (relative error z^2 ulp), hence 1e-13.
TEST(NormalQuantile, InvertsTheDistributionFunction) {
  for (const double p : {1e-16, 1e-12, 1e-8, 1e-5, 1e-3, 0.01, 0.05, 0.075, 0.0751, 0.2, 0.4, 0.5}) {
    const double z = normal_quantile(p);
    EXPECT_NEAR(0.5 * std::erfc(-z / std::sqrt(2.0)) / p, 1, 1e-13) << "p = " << p;
  }
  for (int i = 1; i < 1000; ++i) {
    const double p = i / 1000.0;
    EXPECT_NEAR(0.5 * std::erfc(-normal_quantile(p) / std::sqrt(2.0)), p, 2e-15) << "p = " << p;
  }
}

// Wichura's own check values in AS 241.
TEST(NormalQuantile, PublishedValues) {
  EXPECT_NEAR(normal_quantile(0.25), -0.6744897501960817, 1e-15);
  EXPECT_NEAR(normal_quantile(0.001), -3.090232306167814, 1e-14);
  EXPECT_NEAR(normal_quantile(1e-20), -9.262340089798408, 1e-13);
}

TEST(NormalQuantile, StaysWithinItsLimit) {
  EXPECT_LT(std::abs(normal_quantile(0x1p-53)), kNormalLimit);
  EXPECT_LT(normal_quantile(1 - 0x1p-53), kNormalLimit);
}

// Mean of a normal distribution cut at zero: m + s phi(m/s)/Phi(m/s). The worst case allowed is sd = mean: 1.2876 m.
TEST(RandomStream, PositiveNormalHasTheTruncatedMean) {
  for (const double sd : {0.0, 0.2, 1.0}) {
    RandomStream stream(5, 9);
    constexpr int kDraws = 200000;
    double sum = 0, sum2 = 0;
    for (int i = 0; i < kDraws; ++i) {
      const double x = stream.positive_normal(1.0, sd);
      ASSERT_GT(x, 0);
      sum += x;
      sum2 += x * x;
    }
    const double z = sd > 0 ? 1 / sd : 40;
    const double density = std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi),
                 below = 0.5 * std::erfc(-z / std::sqrt(2.0));
    const double expected = 1 + sd * density / below;
    const double mean = sum / kDraws;
    const double error = std::sqrt(std::max(0.0, sum2 / kDraws - mean * mean) / kDraws);
    EXPECT_NEAR(mean, expected, 3 * error + 1e-12) << "sd = " << sd;
  }
}

// These words were printed once and are compared for ever: a change of compiler, flags or machine must not move a bit.
TEST(RandomStream, SameBitsOnEveryMachine) {
  RandomStream stream(20260101, 4);
  double sum = 0;
  for (int i = 0; i < 1000; ++i) sum += stream.positive_normal(150, 20);
  EXPECT_EQ(sum, 0x1.244f6a634de44p+17) << std::hexfloat << sum;
}

}  // namespace
}  // namespace strandlab
