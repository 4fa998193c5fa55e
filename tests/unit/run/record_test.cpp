// What run.json keeps of virtual tests comes back as it was.
#include "strandlab/run/record.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace strandlab::run {
namespace {

TestedState tested_state() {
  TestedState state;
  state.compaction = 0.1;
  state.wall_s = 0.3;
  state.result.moduli = {{vtest::TestKind::kTension, 0.0105, 1234.5678901234567, 1234.56, {}},
                         {vtest::TestKind::kBending3Point, 0, 900.1, 900.2, 950.3}};
  state.result.strands = 12;
  state.result.floating_strands = 3;
  state.result.glued_fraction = 1. / 3;
  state.result.unknowns = 4567;
  state.result.assemble_s = 1;
  state.result.analyse_s = 2;
  state.result.factor_s = 3;
  state.result.solve_s = 4;
  state.result.warnings = {"a sentence"};
  state.gap_sensitivity = GapSensitivity{0.0105, {-0.25, 0.125}};
  return state;
}

TEST(TestedRecord, ComesBackBitForBit) {
  const auto state = tested_state();
  const auto back = tested_from_json(nlohmann::json::parse(to_json(Tested{state}).dump())).at(0);
  EXPECT_EQ(back.compaction, state.compaction);
  EXPECT_EQ(back.wall_s, state.wall_s);
  ASSERT_EQ(back.result.moduli.size(), 2);
  EXPECT_EQ(back.result.moduli[0].kind, vtest::TestKind::kTension);
  EXPECT_EQ(back.result.moduli[0].modulus_MPa, state.result.moduli[0].modulus_MPa);
  EXPECT_EQ(back.result.moduli[1].shear_free_modulus_MPa, 950.3);
  EXPECT_EQ(back.result.glued_fraction, state.result.glued_fraction);
  EXPECT_EQ(back.result.warnings, state.result.warnings);
  ASSERT_TRUE(back.gap_sensitivity);
  EXPECT_EQ(back.gap_sensitivity->change.doubled, 0.125);
  EXPECT_FALSE(back.not_testable);
  EXPECT_EQ(to_json(Tested{back}), to_json(Tested{state}));  // and everything else
}

TEST(TestedRecord, KeepsWhyAPanelHasNoModuli) {
  TestedState state;
  state.not_testable = NotTestable{"nothing connects its ends", true};
  const auto json = to_json(Tested{state});
  EXPECT_FALSE(json[0].contains("gap_sensitivity"));
  const auto back = tested_from_json(json).at(0);
  ASSERT_TRUE(back.not_testable);
  EXPECT_EQ(back.not_testable->reason, "nothing connects its ends");
  EXPECT_TRUE(back.not_testable->failed);
}

// The line of a terminal and of log.txt.
TEST(ProgressLine, HasStepAndPercent) {
  EXPECT_EQ(line_of({"press", 0.334, "compaction 0.1"}), "press   33 %  compaction 0.1");
  EXPECT_EQ(line_of({"test", 1, "compaction 0.4"}), "test   100 %  compaction 0.4");
}

}  // namespace
}  // namespace strandlab::run
