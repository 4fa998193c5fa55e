// Statistics of a study on moduli that are made up: what pairing takes out, effects with known values.
#include "strandlab/study/effects.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "samples.hpp"

namespace strandlab::study {
namespace {

const Measure kTension{1, "tension", 1};

Observation made_up(std::size_t cell, std::uint64_t replicate, double modulus) {
  return {cell, replicate, kTension, 0.1, 400, 0.01, modulus};
}

// Mats differ by hundreds, the cells by 10 and a little on each: the paired interval holds 10 and is a few wide.
// Student's t with 2 degrees of freedom: 10 +- 4.303 x 1/sqrt(3).
TEST(StudyObservations, PairingTakesTheMatsOutOfADifference) {
  Observations all;
  const std::vector<double> mats{1000, 1300, 1700}, little{-1, 0, 1};
  for (std::uint64_t r = 0; r < 3; ++r) {
    all.add(made_up(0, r + 1, mats[r]));
    all.add(made_up(1, r + 1, mats[r] + 10 + little[r]));
  }
  const auto found = all.difference({1}, {0});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].modulus_MPa.n, 3);
  EXPECT_NEAR(found[0].modulus_MPa.mean, 10, 1e-10);
  EXPECT_NEAR(found[0].modulus_MPa.high, 10 + 4.302653 / std::sqrt(3), 1e-5);
  EXPECT_NEAR(found[0].reference_MPa, 4000 / 3.0, 1e-10);
  EXPECT_NEAR(all.of_cell(0)[0].modulus_MPa.sd, 351.1885, 1e-3);  // sqrt(((1000-m)^2 + (1300-m)^2 + (1700-m)^2)/2)
}

TEST(StudyObservations, OnlyReplicatesOfBothCellsArePaired) {
  Observations all;
  all.add(made_up(0, 1, 1));
  all.add(made_up(0, 2, 5));
  all.add(made_up(1, 2, 6));
  all.add(made_up(1, 3, 100));
  const auto found = all.difference({1}, {0});
  EXPECT_EQ(found[0].modulus_MPa.n, 1);
  EXPECT_EQ(found[0].modulus_MPa.mean, 1);
  EXPECT_TRUE(std::isnan(found[0].modulus_MPa.low));
  EXPECT_TRUE(all.difference({2}, {0}).empty());
}

// The compaction of a density differs between mats: its mean is shown; a glue that differs is none.
TEST(StudyObservations, WhatDiffersBetweenPanelsIsAMeanAndAChoiceNone) {
  Observations all;
  all.add({0, 1, kTension, 0.1, 400, 0.01, 1});
  all.add({0, 2, kTension, 0.2, 400, 0.02, 1});
  const auto found = all.of_cell(0)[0];
  EXPECT_NEAR(found.compaction, 0.15, 1e-15);
  EXPECT_EQ(found.density_kg_m3, 400);
  EXPECT_TRUE(std::isnan(found.compliance_t_mm_per_MPa));
}

// Modulus = 100 + 5 for the second x + 20 (40) for the second (third) y, and the mat.
TEST(StudyEffects, MainEffectsOfACrossedPlan) {
  const auto plan = plan_of("base = 'osb'\nreplicates = 2\n[axes]\na.x = [1, 2]\na.y = ['p', 'q', 'r']\n");
  Observations all;
  const auto cells = cells_of(plan);
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::uint64_t r = 1; r <= 2; ++r)
      all.add(made_up(i, r,
                      100 + 5.0 * static_cast<double>(cells[i][0]) + 20.0 * static_cast<double>(cells[i][1]) +
                          7.0 * static_cast<double>(r)));
  const auto effects = main_effects(plan, all);
  ASSERT_EQ(effects.size(), 3U);
  EXPECT_EQ(effects[0].factor, "a.x");
  EXPECT_NEAR(effects[0].finding.modulus_MPa.mean, 5, 1e-10);
  EXPECT_EQ(effects[2].value, "r");
  EXPECT_EQ(effects[2].against, "p");
  EXPECT_NEAR(effects[2].finding.modulus_MPa.mean, 40, 1e-10);
  EXPECT_EQ(effects[2].finding.modulus_MPa.n, 2);
}

TEST(StudyEffects, OneAtATimeIsAgainstTheBase) {
  const auto plan = plan_of("base = 'osb'\n[one_at_a_time]\na.x = [1]\na.y = [7]\n");
  Observations all;
  for (const auto& [cell, modulus] : {std::pair{0, 50.0}, {1, 53.0}, {2, 40.0}})
    all.add(made_up(static_cast<std::size_t>(cell), 1, modulus));
  const auto effects = main_effects(plan, all);
  ASSERT_EQ(effects.size(), 2U);
  EXPECT_EQ(effects[0].factor + effects[0].value + effects[0].against, "a.x1base");
  EXPECT_EQ(effects[0].finding.modulus_MPa.mean, 3);
  EXPECT_EQ(effects[1].factor, "a.y");
  EXPECT_EQ(effects[1].finding.modulus_MPa.mean, -10);
}

// A plane, z = 3 x - 2 y and the mat, is found exactly, from end to end of the intervals.
TEST(StudyEffects, SlopesOfALatinHypercube) {
  const auto plan =
      plan_of("base = 'osb'\n[latin_hypercube]\nsamples = 9\na.x = {from = 1, to = 3}\na.y = {from = 0, to = 10}\n");
  Observations all;
  for (std::size_t i = 0; i < 9; ++i)
    for (std::uint64_t r = 1; r <= 2; ++r)
      all.add(made_up(i, r,
                      3 * std::stod(plan.blocks[0].rows[i][0]) - 2 * std::stod(plan.blocks[0].rows[i][1]) +
                          100.0 * static_cast<double>(r)));
  const auto effects = main_effects(plan, all);
  ASSERT_EQ(effects.size(), 2U);
  EXPECT_NEAR(effects[0].finding.modulus_MPa.mean, 6, 1e-9);
  EXPECT_NEAR(effects[1].finding.modulus_MPa.mean, -20, 1e-9);
  EXPECT_EQ(effects[1].value + " " + effects[1].against, "10 0");
}

TEST(StudyEffects, AContrastIsFoundInEveryCombinationOfTheOthers) {
  const auto plan = plan_of(
      "base = 'osb'\n[axes]\na.x = [1, 2, 3]\na.y = ['p', 'q']\n[[contrasts]]\nkey = 'a.x'\nvalue = 3\nagainst = 1\n");
  const auto pairs = contrasted_cells(plan);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[1].name, "a.x: 3 - 1");
  EXPECT_EQ(pairs[1].values, (std::vector<std::string>{"3 - 1", "q"}));
  EXPECT_EQ(pairs[1].first, 5U);
  EXPECT_EQ(pairs[1].second, 1U);
}

}  // namespace
}  // namespace strandlab::study
