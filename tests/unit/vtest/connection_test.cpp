// Which strands carry load from end to end, and of which mats none ever can.
#include "strandlab/vtest/connection.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "strandlab/core/error.hpp"
#include "strandlab/vtest/vtest.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::vtest {
namespace {

struct Piece {
  double x0, x1;  // mm
};

constexpr double kThick = 0.8;  // mm

// Rows of strands, bottom to top, in a window of 100 mm.
Panel<2> mat_of(const std::vector<std::vector<Piece>>& rows) {
  mat::Mat mat;
  mat.length_mm = 100;
  mat.layer_thickness_mm = kThick;
  for (const auto& row : rows) {
    auto& layer = mat.layers.emplace_back();
    layer.role = "surface";
    for (const auto& piece : row) {
      auto& strand = layer.strands.emplace_back();
      strand.x0_mm = piece.x0;
      strand.x1_mm = piece.x1;
    }
  }
  return make_panel(mat, {{"surface", wood::Material{}, 0}}, kThick, 1);
}

// Ends of strands in one row do not bond, however hard they are pressed against one another.
TEST(CanConnect, OneRowOnlyByAStrandFromEndToEnd) {
  EXPECT_TRUE(can_connect(mat_of({{{0, 100}}}), 0.4));
  EXPECT_FALSE(can_connect(mat_of({{{0, 40}, {50, 100}}}), 0.4));
  EXPECT_FALSE(can_connect(mat_of({{{0, 50}, {50, 100}}}), 0.9));
  EXPECT_FALSE(can_connect(mat_of({{{0, 95}, {99, 100}}}), 0.4));
}

TEST(CanConnect, ByStrandsThatLieOverOneAnother) {
  EXPECT_TRUE(can_connect(mat_of({{{0, 60}}, {{55, 100}}}), 0));
  EXPECT_TRUE(can_connect(mat_of({{{0, 40}, {50, 100}}, {{30, 70}}}), 0));
  EXPECT_FALSE(can_connect(mat_of({{{0, 40}, {50, 100}}, {{0, 20}}}), 0)) << "the gap is bridged by nothing";
  EXPECT_FALSE(can_connect(mat_of({{{10, 60}}, {{55, 100}}}), 0)) << "nothing at x = 0";
}

// A strand of 20 mm gains 20 C/(1 - C) = 13.3 mm at C = 0.4, and may be moved by the mat's thickness, 1.6 mm: one that
// begins 14 mm from the end may come to it, one at 16 mm may not; two may meet over a gap of 29 mm, not over one of 31.
TEST(CanConnect, LeavesRoomForWhatThePressMoves) {
  EXPECT_TRUE(can_connect(mat_of({{{14, 34}, {60, 80}}, {{40, 60}, {80, 100}}}), 0.4));
  EXPECT_FALSE(can_connect(mat_of({{{16, 36}, {60, 80}}, {{40, 60}, {80, 100}}}), 0.4));
  EXPECT_TRUE(can_connect(mat_of({{{0, 20}, {69, 89}}, {{49, 69}, {80, 100}}}), 0.4));
  EXPECT_FALSE(can_connect(mat_of({{{0, 20}, {71, 91}}, {{51, 71}, {80, 100}}}), 0.4));
}

TEST(CheckEnds, SaysWhatHelps) {
  const auto message = test::message_of<InputError>([] { check_ends(mat_of({{{0, 40}, {50, 100}}}), 0.4); });
  for (const auto* part : {"x = 100 mm", "do not bond", "mat.rows", "gap_mm = 0", "strandlab press"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_NO_THROW(check_ends(mat_of({{{0, 100}}}), 0.4));
}

}  // namespace
}  // namespace strandlab::vtest
