#include "strandlab/report/layer_picture.hpp"

#include <gtest/gtest.h>

namespace strandlab::report {
namespace {

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// A strand that crosses an edge is drawn again where its image comes in; one in a cut mat is not.
TEST(LayerPicture, ShowsImagesThatReachIntoTheWindow) {
  mat::PlateMat mat;
  mat.length_mm = mat.width_mm = 100;
  mat.layer_thickness_mm = 0.8;
  mat.layers = {{"core", {{98, 50, 20, 4, 0, {}, {}}}, {}, {}}};
  const std::vector<mat::RoleAngle> roles{{"core", 90}};
  const auto torus = layer_picture(mat, 0, roles);
  EXPECT_EQ(count_of(torus, "translate(98.000 50.000)"), 1);
  EXPECT_EQ(count_of(torus, "translate(-2.000 50.000)"), 1);
  EXPECT_NE(torus.find("1 strands, 1 % of the window"), std::string::npos);
  mat.sides = mat::PlateSides::kCut;
  EXPECT_EQ(count_of(layer_picture(mat, 0, roles), "translate("), 2);  // the window and the strand
}

}  // namespace
}  // namespace strandlab::report
