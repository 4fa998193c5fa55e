// Plan files: the cells they stand for, and what bad ones are told.
#include "strandlab/study/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "samples.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/study/sampling.hpp"

namespace strandlab::study {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using Values = std::vector<std::string>;

std::vector<Values> all_values(const Plan& plan) {
  std::vector<Values> list;
  for (const auto& cell : cells_of(plan)) list.push_back(values_of(plan, cell));
  return list;
}

std::string plan_refusal(const std::string& text) {
  return test::message_of<InputError>([&] { plan_of(text); });
}

TEST(StudyPlan, CrossesAxesTheLastFastest) {
  const auto plan = plan_of(
      "base = 'osb'\nreplicates = 5\n[axes]\n'press.speed_m_s' = [4, 16]\n'kinds.core.law' = ['hill', 'crushing']\n");
  EXPECT_EQ(plan.replicates, 5);
  EXPECT_THAT(varied_keys(plan), ElementsAre("press.speed_m_s", "kinds.core.law"));
  EXPECT_THAT(all_values(plan), ElementsAre(Values{"4", "'hill'"}, Values{"4", "'crushing'"}, Values{"16", "'hill'"},
                                            Values{"16", "'crushing'"}));
  EXPECT_EQ(shown("'hill'"), "hill");
}

// A plan without anything that varies is replicates of one case.
TEST(StudyPlan, HasOneCellWithoutAxes) {
  EXPECT_EQ(cells_of(plan_of("base = 'osb'")).size(), 1U);
  EXPECT_EQ(plan_of("base = 'osb'").replicates, 1);
}

TEST(StudyPlan, KeysOfAZipChangeTogether) {
  const auto plan =
      plan_of("base = 'osb'\n[[zip]]\n'kinds.core.length_mm' = [75, 75, 150]\n'kinds.core.gap_mm' = [15, 30, 15]\n");
  EXPECT_THAT(all_values(plan), ElementsAre(Values{"75", "15"}, Values{"75", "30"}, Values{"150", "15"}));
}

TEST(StudyPlan, TakesKeysWithoutQuotesToo) {
  const auto plan = plan_of("base = 'osb'\n[axes]\npress.speed_m_s = [4, 16]\nkinds.core.law = ['hill']\n");
  EXPECT_THAT(varied_keys(plan), ElementsAre("press.speed_m_s", "kinds.core.law"));
}

TEST(StudyPlan, TakesRanges) {
  const auto plan =
      plan_of("base = 'osb'\n[axes]\na.x = {from = 0.1, to = 0.3, step = 0.1}\na.y = {from = 1, to = 2, count = 3}\n");
  EXPECT_THAT(plan.blocks[0].rows, ElementsAre(Values{"0.1"}, Values{"0.2"}, Values{"0.3"}));
  EXPECT_THAT(plan.blocks[1].rows, ElementsAre(Values{"1"}, Values{"1.5"}, Values{"2"}));
  EXPECT_THAT(stepped(0, 1, 0.4), ElementsAre(0, 0.4, 0.8));  // the end is not reached
  EXPECT_THAT(stepped(1, 0, -0.5), ElementsAre(1, 0.5, 0));
}

TEST(StudyPlan, OneAtATimeLeavesTheOthersAsTheBaseHasThem) {
  const auto plan = plan_of("base = 'osb'\n[one_at_a_time]\na.x = [1, 3]\na.y = [7]\n");
  EXPECT_THAT(all_values(plan), ElementsAre(Values{"", ""}, Values{"1", ""}, Values{"3", ""}, Values{"", "7"}));
}

// McKay, Beckman & Conover (1979): each of the n strata of each interval holds one of the n samples.
TEST(StudyPlan, LatinHypercubeHasOneSampleInEachStratum) {
  constexpr int kSamples = 20;
  const std::vector<Interval> intervals{{0, 1}, {-5, 15}};
  const auto samples = latin_hypercube(intervals, kSamples, 3);
  ASSERT_EQ(samples.size(), 20U);
  for (std::size_t k = 0; k < intervals.size(); ++k) {
    std::set<int> strata;
    for (const auto& sample : samples)
      strata.insert(
          static_cast<int>(kSamples * (sample[k] - intervals[k].from) / (intervals[k].to - intervals[k].from)));
    EXPECT_EQ(strata.size(), 20U);
    EXPECT_EQ(*strata.begin(), 0);
    EXPECT_EQ(*strata.rbegin(), 19);
  }
  EXPECT_EQ(samples, latin_hypercube(intervals, kSamples, 3));
  EXPECT_NE(samples, latin_hypercube(intervals, kSamples, 4));
  EXPECT_EQ(samples[7][0], latin_hypercube({{0, 1}}, kSamples, 3)[7][0]);  // keys added behind change nothing
}

TEST(StudyPlan, LatinHypercubeOfAPlan) {
  const auto plan = plan_of("base = 'osb'\n[latin_hypercube]\nsamples = 4\nseed = 2\na.x = {from = 1, to = 3}\n");
  ASSERT_EQ(plan.blocks[0].rows.size(), 4U);
  EXPECT_EQ(plan.blocks[0].intervals[0].second, 3);
  EXPECT_EQ(std::stod(plan.blocks[0].rows[1][0]), latin_hypercube({{1, 3}}, 4, 2)[1][0]);
}

struct Bad {
  const char *text, *message;
};

// Where, what was given, what is allowed.
TEST(StudyPlan, RefusesBadPlans) {
  for (const auto& [text, message] : std::vector<Bad>{
           {"[axes", "plan.toml:1: not valid TOML"},
           {"replicates = 2", "no \"base\""},
           {"base = 3", "plan.toml:1: base must be a text"},
           {"base = 'osb'\nreplicats = 2",
            "plan.toml:2: plan: unknown key \"replicats\"; did you mean \"replicates\"?"},
           {"base = 'osb'\nreplicates = 0",
            "plan.toml:2: plan: \"replicates\" must be a whole number from 1 to 100000, not 0"},
           {"base = 'osb'\nreplicates = 2.5", "must be a whole number"},
           {"base = 'osb'\nbase_seed = -1", "\"base_seed\" must be a whole number from 0"},
           {"base = 'osb'\naxes = 3", "plan.toml:2: axes is a table: its keys follow a line [axes]"},
           {"base = 'osb'\n[axes]\na.x = []", "plan.toml:3: a.x: no values"},
           {"base = 'osb'\n[axes]\na.x = 3",
            "plan.toml:3: a.x: values are a list, {from, to, step} or {from, to, count}, not 3"},
           {"base = 'osb'\n[axes]\na.x = [1, 1.0]", "a.x: 1 stands there twice"},
           {"base = 'osb'\n[axes]\na.x = [1979-05-27]", "a.x: a value is a number"},
           {"base = 'osb'\n[axes]\na.x = [\"a\\nb\"]", "a text on one line"},
           {"base = 'osb'\n[axes]\na.x = {}", "a.x: a range needs \"from\""},
           {"base = 'osb'\n[axes]\na.x = {from = 1, to = 2}", "a \"step\" or a \"count\", one of them"},
           {"base = 'osb'\n[axes]\na.x = {from = 1, to = 2, step = 1, count = 2}", "one of them"},
           {"base = 'osb'\n[axes]\na.x = {from = 1, to = 2, step = -1}", "steps of -1 do not lead from 1 to 2"},
           {"base = 'osb'\n[axes]\na.x = {from = 1, to = 2, step = 1e-9}", "more than 100000 values"},
           {"base = 'osb'\n[axes]\na.x = {from = 1, to = 2, count = 1}", "\"count\" must be a whole number from 2"},
           {"base = 'osb'\n[axes]\na.x = {from = 1, to = inf, count = 3}", "needs \"to\", a number"},
           {"base = 'osb'\n[axes]\na.x = {from = 1, to = 2, stp = 1}", "unknown key \"stp\"; did you mean \"step\"?"},
           {"base = 'osb'\n[axes]\na.x = {from = 1, to = 1e4, step = 1}\na.y = {from = 1, to = 1e4, step = 1}",
            "1e+08 items; a study has at most 100000"},
           {"base = 'osb'\n[axes]\na.x = [1]\n[[zip]]\na.x = [1]\na.y = [1]",
            "a.x is given twice, also at plan.toml:3"},
           {"base = 'osb'\n[set]\na.x = 1\n[axes]\na.x = [1]", "a.x is given twice"},
           {"base = 'osb'\n[axes]\nrun.seed = [1, 2]", "plan.toml:3: run.seed is set by the replicates"},
           {"base = 'osb'\n[[zip]]\na.x = [1, 2]\na.y = [1]", "plan.toml:4: a.y: 1 values, but a.x has 2"},
           {"base = 'osb'\n[[zip]]\n", "zip: no values"},
           {"base = 'osb'\n[zip]\na.x = [1]", "zip is a list of tables: each follows a line [[zip]]"},
           {"base = 'osb'\n[latin_hypercube]\na.x = {from = 1, to = 2}",
            "\"samples\" must be a whole number from 2 to 100000, and is missing"},
           {"base = 'osb'\n[latin_hypercube]\nsamples = 4", "latin_hypercube: no keys"},
           {"base = 'osb'\n[latin_hypercube]\nsamples = 4\na.x = [1, 2]", "in a Latin hypercube a key has {from, to}"},
           {"base = 'osb'\n[latin_hypercube]\nsamples = 4\na.x = {from = 2, to = 1}",
            "\"from\" must be less than \"to\""},
           {"base = 'osb'\n[one_at_a_time]\n", "one_at_a_time: no keys"},
           {"base = 'osb'\n[axes]\na.x = [1, 2]\n[[contrasts]]\nkey = 'a.x'\nvalue = 3\nagainst = 1",
            "plan.toml:4: contrast: a.x = 3 is no value of the axis; values of the axis: 1, 2"},
           {"base = 'osb'\n[axes]\na.x = [1, 2]\n[[contrasts]]\nkey = 'a.x'\nvalue = 1\nagainst = 1", "are the same"},
           {"base = 'osb'\n[axes]\na.xyz = [1, 2]\n[[contrasts]]\nkey = 'a.xyy'\nvalue = 2\nagainst = 1",
            "a.xyy is no axis; did you mean a.xyz?"},
           {"base = 'osb'\n[axes]\na.x = [1, 2]\n[[contrasts]]\nkey = 'a.x'\nvalue = 2", "needs \"key\""},
           {"base = 'osb'\n[[zip]]\na.x = [1, 1]\na.y = [1, 2]\n[[contrasts]]\nkey = 'a.x'\nvalue = 1\nagainst = 2",
            "stands in several rows"},
       })
    EXPECT_THAT(plan_refusal(text), HasSubstr(message)) << text;
}

TEST(StudyPlan, NamesAFileThatIsNotThere) {
  EXPECT_THAT(test::message_of<InputError>([] { read_plan("nowhere.toml"); }),
              HasSubstr("nowhere.toml: no such plan file"));
  EXPECT_THAT(test::message_of<InputError>([] { read_plan("."); }), HasSubstr("no such plan file"));
}

}  // namespace
}  // namespace strandlab::study
