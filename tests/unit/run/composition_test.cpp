// What a mat is made of, in words.
#include "strandlab/run/composition.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace strandlab::run {
namespace {

std::string shares(const std::vector<std::string>& keys) {
  return remark_on_shares(cases::case_from_text("", "panel.toml", keys)).value_or("none");
}

// Face rows are 150/165 wood, core rows 25/35: of 5 + 10 + 5 rows 10 x .90909/(10 x .90909 + 10 x .71429) = 56.0 %.
TEST(Composition, TellsTheSharesOfNeighbouringLayups) {
  EXPECT_EQ(shares({}),
            "surface by weight, mean over random mats: 4 + 12 + 4 rows 45.9 %, 5 + 10 + 5 rows 56.0 %, 6 + 8 + 6 rows "
            "65.6 %");
  EXPECT_EQ(shares({"mat.rows=[\"surface\", \"core*2\", \"surface\"]"}),
            "surface by weight, mean over random mats: 1 + 2 + 1 rows 56.0 %");
  EXPECT_EQ(shares({"mat.rows=[\"surface*20\"]"}), "none");
  EXPECT_EQ(shares({"mat.rows=[\"surface\", \"core*2\", \"surface*2\"]"}), "none");
  EXPECT_EQ(shares({"mat.rows=[\"surface\", \"core\", \"surface\", \"core\", \"surface\"]"}), "none");
  EXPECT_EQ(shares({"mat.rows=[\"surface\", \"core\"]"}), "none");
}

// Cores twice as thick weigh twice as much.
TEST(Composition, SharesAreByWeight) {
  EXPECT_EQ(shares({"mat.rows=[\"surface\", \"core*2\", \"surface\"]", "kinds.core.thickness_mm=1.6"}),
            "surface by weight, mean over random mats: 1 + 2 + 1 rows 38.9 %");
}

}  // namespace
}  // namespace strandlab::run
