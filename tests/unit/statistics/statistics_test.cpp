#include "strandlab/statistics/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "strandlab/core/error.hpp"

namespace strandlab::statistics {
namespace {

// Student, "The probable error of a mean", Biometrika 6 (1908) 1: hours of sleep gained with two drugs by ten patients.
const std::vector<double> kSleep1{0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
const std::vector<double> kSleep2{1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};

// Dobson, An Introduction to Statistical Modelling (1983): dried weight of plants, control and two treatments.
const std::vector<std::vector<double>> kPlants{{4.17, 5.58, 5.18, 6.11, 4.50, 4.61, 5.17, 4.53, 5.33, 5.14},
                                               {4.81, 4.17, 4.41, 3.59, 5.87, 3.83, 6.03, 4.89, 4.32, 4.69},
                                               {6.31, 5.12, 5.54, 5.50, 5.37, 5.29, 4.92, 6.15, 5.80, 5.26}};

// NIST Statistical Reference Datasets, SiRstv (one-way analysis of variance): resistivity of silicon by five
// instruments.
const std::vector<std::vector<double>> kSiRstv{{196.3052, 196.1240, 196.1890, 196.2569, 196.3403},
                                               {196.3042, 196.3825, 196.1669, 196.3257, 196.0422},
                                               {196.1303, 196.2005, 196.2889, 196.0343, 196.1811},
                                               {196.2795, 196.1748, 196.1494, 196.1485, 195.9885},
                                               {196.2119, 196.1051, 196.1850, 196.0052, 196.2090}};

TEST(Statistics, OneSampleTestOfStudentsSleepData) {
  std::vector<double> gain;
  for (std::size_t i = 0; i < kSleep1.size(); ++i) gain.push_back(kSleep2[i] - kSleep1[i]);
  const Summary s = summarise(gain);
  EXPECT_EQ(s.n, 10);
  EXPECT_NEAR(s.mean, 1.58, 1e-12);
  EXPECT_NEAR(s.t, 4.0621, 5e-5);  // R, t.test on the same data: t, p and the interval
  EXPECT_NEAR(s.p, 0.002833, 5e-7);
  EXPECT_NEAR(s.low, 0.7001142, 5e-8);
  EXPECT_NEAR(s.high, 2.4598858, 5e-8);
}

TEST(Statistics, FewValuesGiveNoSpread) {
  EXPECT_EQ(summarise({}).n, 0);
  EXPECT_TRUE(std::isnan(summarise({}).mean));
  const Summary one = summarise({3});
  EXPECT_EQ(one.mean, 3);
  EXPECT_TRUE(std::isnan(one.sd) && std::isnan(one.low) && std::isnan(one.p));
  const Summary same = summarise({3, 3});
  EXPECT_EQ(same.sd, 0);
  EXPECT_TRUE(std::isnan(same.t));
}

TEST(Statistics, AnovaOfSiliconResistivityMatchesCertifiedValues) {
  const Anova a = anova(kSiRstv);
  EXPECT_EQ(a.df_between, 4);
  EXPECT_EQ(a.df_within, 20);
  EXPECT_NEAR(a.F, 1.18046237440255, 1e-10);
  EXPECT_NEAR(a.ss_between, 5.11462616000000e-2, 1e-12);
  EXPECT_NEAR(a.ss_within, 2.16636560000000e-1, 1e-12);
  EXPECT_NEAR(a.p, 0.349, 5e-4);  // R, pf(1.18046237440255, 4, 20, lower.tail = FALSE)
}

TEST(Statistics, AnovaOfPlantWeights) {
  const Anova a = anova(kPlants);
  EXPECT_NEAR(a.F, 4.846, 5e-4);  // R, anova(lm(weight ~ group, PlantGrowth))
  EXPECT_NEAR(a.p, 0.01591, 5e-6);
  const WelchAnova w = welch_anova(kPlants);
  EXPECT_NEAR(w.F, 5.181, 5e-4);  // R, oneway.test(weight ~ group, PlantGrowth)
  EXPECT_NEAR(w.df_within, 17.128, 5e-4);
  EXPECT_NEAR(w.p, 0.01739, 5e-6);
}

TEST(Statistics, WelchPairOfStudentsSleepData) {
  const auto pairs = holm_welch_pairs({kSleep1, kSleep2});
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_NEAR(pairs[0].t, -1.8608, 5e-5);  // R, t.test(extra ~ group, sleep)
  EXPECT_NEAR(pairs[0].df, 17.776, 5e-4);
  EXPECT_NEAR(pairs[0].p, 0.07939, 5e-6);
  EXPECT_NEAR(pairs[0].low, -3.3654832, 5e-7);
  EXPECT_NEAR(pairs[0].high, 0.2054832, 5e-7);
  EXPECT_EQ(pairs[0].p_holm, pairs[0].p);  // nothing to correct for one pair
}

TEST(Statistics, HolmCorrectionStepsDown) {
  const auto pairs = holm_welch_pairs(kPlants);
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_NEAR(pairs[0].p, 0.2504, 5e-5);    // control, treatment 1: t = 1.1913, df = 16.524
  EXPECT_NEAR(pairs[1].p, 0.0479, 5e-5);    // control, treatment 2: t = -2.134, df = 16.786
  EXPECT_NEAR(pairs[2].p, 0.009298, 5e-7);  // treatments 1, 2: t = -3.0101, df = 14.104
  EXPECT_NEAR(pairs[2].p_holm, 3 * pairs[2].p, 1e-12);
  EXPECT_NEAR(pairs[1].p_holm, 2 * pairs[1].p, 1e-12);
  EXPECT_NEAR(pairs[0].p_holm, pairs[0].p, 1e-12);
}

TEST(Statistics, HolmNeverOrdersCorrectedValuesAgainstTheData) {
  // Three alike groups: the largest p times one must not fall below the middle one times two.
  const auto pairs = holm_welch_pairs({{1, 2, 3, 4}, {1.1, 2.2, 3.1, 4.4}, {0.9, 2.1, 3.3, 3.9}});
  for (const auto& a : pairs)
    for (const auto& b : pairs)
      if (a.p <= b.p) {
        EXPECT_LE(a.p_holm, b.p_holm);
      }
  for (const auto& pair : pairs) EXPECT_LE(pair.p_holm, 1);
}

TEST(Statistics, ComparisonsNeedGroups) {
  EXPECT_THROW(anova({{1, 2}}), InputError);
  EXPECT_THROW(anova({{1}, {2}}), InputError);
  EXPECT_THROW(anova({{1, 2}, {}}), InputError);
  EXPECT_THROW(welch_anova({{1, 2}, {3}}), InputError);
  EXPECT_THROW(holm_welch_pairs({{1, 2}, {3, 3}}), InputError);
}

// Anscombe, The American Statistician 27 (1973) 17, first data set: slope .5001 with standard error .1179, t = 4.24,
// p = .00217 (R, summary(lm(y1 ~ x1, anscombe))); df = 9.
TEST(Statistics, SlopeOfAnscombesFirstSet) {
  Eigen::VectorXd x(11), y(11);
  x << 10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5;
  y << 8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68;
  x.array() -= x.mean();
  y.array() -= y.mean();
  const auto found = slopes(x, y, 1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].n, 11);
  EXPECT_NEAR(found[0].mean, 0.5001, 5e-5);
  EXPECT_NEAR(found[0].sd, 0.1179, 5e-5);
  EXPECT_NEAR(found[0].t, 4.241, 5e-4);
  EXPECT_NEAR(found[0].p, 0.00217, 5e-6);
  EXPECT_NEAR(found[0].high - found[0].mean, 2.262157 * found[0].sd, 1e-6);  // Student's t, 9 degrees of freedom
}

TEST(Statistics, NoSlopesWhereColumnsDoNotDetermineThem) {
  Eigen::MatrixXd x(3, 2);
  x << 1, 2, -1, -2, 0, 0;
  EXPECT_TRUE(slopes(x, Eigen::VectorXd::Ones(3), 1).empty());
  const auto exact = slopes(Eigen::VectorXd{{-1, 1}}, Eigen::VectorXd{{-3, 3}}, 1);  // no degree of freedom left
  EXPECT_NEAR(exact.at(0).mean, 3, 1e-12);
  EXPECT_TRUE(std::isnan(exact.at(0).low));
}

}  // namespace
}  // namespace strandlab::statistics
