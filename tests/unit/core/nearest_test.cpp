#include "strandlab/core/nearest.hpp"

#include <gtest/gtest.h>

namespace strandlab {
namespace {

TEST(EditDistance, CountsSingleSlips) {
  EXPECT_EQ(edit_distance("core", "core"), 0);
  EXPECT_EQ(edit_distance("core", "Core"), 0);   // case
  EXPECT_EQ(edit_distance("core", "cor"), 1);    // deletion
  EXPECT_EQ(edit_distance("core", "score"), 1);  // insertion
  EXPECT_EQ(edit_distance("core", "care"), 1);   // replacement
  EXPECT_EQ(edit_distance("core", "croe"), 1);   // swap of neighbours
  EXPECT_EQ(edit_distance("", "core"), 4);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);  // Levenshtein's classic
}

TEST(Nearest, FindsTheMeantName) {
  const std::vector<std::string> keys{"length_mm", "layer_thickness_mm", "speed_m_s", "K", "n"};
  EXPECT_EQ(nearest("lenght_mm", keys), "length_mm");
  EXPECT_EQ(nearest("speed_ms", keys), "speed_m_s");
  EXPECT_EQ(nearest("layer_thicknes", keys), "layer_thickness_mm");
  EXPECT_EQ(nearest("k", keys), "K");
}

TEST(Nearest, StaysSilentWhenNothingIsNear) {
  EXPECT_EQ(nearest("temperature", {"length_mm", "speed_m_s"}), "");
  EXPECT_EQ(nearest("x", {"K", "n"}), "");
  EXPECT_EQ(nearest("core", {}), "");
}

TEST(Nearest, TakesTheClosest) {
  EXPECT_EQ(nearest("x1", {"x11", "x1", "x2"}), "x1");
}

TEST(QuotedList, ReadsAsASentence) {
  EXPECT_EQ(quoted_list({"surface", "core"}), "\"surface\", \"core\"");
}

}  // namespace
}  // namespace strandlab
