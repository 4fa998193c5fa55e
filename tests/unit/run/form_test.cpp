// What is formed: the states of its mat, and what is said of its length.
#include "strandlab/run/form.hpp"

#include <gtest/gtest.h>

namespace strandlab::run {
namespace {

// Default strands: 150 mm along, so that three of them take 450 mm.
TEST(Formed, IsRemarkedOnWhereShorterThanThreeStrands) {
  const auto with_length = [](const char* length) {
    return remark_on_length(form(cases::case_from_text("", "panel.toml", {std::string("mat.length_mm=") + length})));
  };
  const auto remark = with_length("100");
  ASSERT_TRUE(remark.has_value());
  EXPECT_EQ(
      *remark,
      "the mat is 100 mm long, 0.67 lengths of its longest strands: moduli scatter between seeds; the mean of four "
      "seeds scatters half as much, a mat of 450 mm holds 3 lengths");
  EXPECT_FALSE(with_length("450").has_value());
}

// Strands across that are wider than any strand: most likely their length was meant.
TEST(Formed, IsWarnedOfWhereLengthIsTakenForWidth) {
  const auto remarks = [](std::vector<std::string> keys) {
    return remarks_on_widths(cases::case_from_text("", "panel.toml", keys));
  };
  ASSERT_EQ(remarks({"kinds.core.length_mm=120"}).size(), 1);
  EXPECT_EQ(remarks({"kinds.core.length_mm=120"}).front(),
            "kinds.core: strands at 90 degrees are cut across their grain, and length_mm = 120 is what the section "
            "shows, their width; if that is the length of whole strands, give kinds.core.width_mm too");
  EXPECT_TRUE(remarks({}).empty());
  EXPECT_TRUE(remarks({"kinds.core.length_mm=120", "kinds.core.width_mm=20"}).empty());
  EXPECT_TRUE(remarks({"kinds.core.length_mm=120", "kinds.core.angle_deg=30"}).empty());
  EXPECT_TRUE(remarks({"kinds.core.length_mm=120", "mat.rows=[\"surface*3\"]"}).empty());
}

// Density times thickness is the mat's weight, whatever the state; the density asked for is met to 1e-4 of compaction.
TEST(Formed, HasItsStatesByWeight) {
  const auto formed = form(cases::case_from_text("", "panel.toml", {"press.densities_kg_m3=[400, 640]"}));
  const double weight = cases::weigh(formed.c, formed.mat).kg_per_m2;
  const auto states = kept_states(formed);
  ASSERT_EQ(states.size(), 2);
  EXPECT_EQ(states[1].compaction, formed.c.schedule.compactions[1]);
  for (const auto& state : states) EXPECT_NEAR(1e-3 * state.density_kg_m3 * state.thickness_mm, weight, 1e-12 * weight);
  EXPECT_NEAR(states[0].density_kg_m3, 400, 0.04);
  EXPECT_NEAR(states[1].density_kg_m3, 640, 0.1);
}

}  // namespace
}  // namespace strandlab::run
