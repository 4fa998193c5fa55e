#include "strandlab/mat/plate_form.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>

#include "strandlab/core/error.hpp"

namespace strandlab::mat {
namespace {

const std::vector<RoleAngle> kFormedRoles{{"surface", 0}, {"core", 90}};

PlateLayup small_plate(Stack stack = Stack::kLayers) {
  PlateLayup layup;
  layup.length_mm = layup.width_mm = 60;
  layup.stack = stack;
  layup.sequential.rsa_failures = 2000;
  const PlateRow surface{"surface", {40, 4, 8, 1}, {0, 0, 25}}, core{"core", {40, 4, 8, 1}, {90, 0, 25}};
  layup.rows = {surface, surface, core, core, core, surface};
  return layup;
}

// What is formed is a mat as its file would have it: no overlap, every number on the raster.
TEST(FormPlate, MakesValidMatsOnTheRasterOfTheirFile) {
  for (const auto stack : {Stack::kLayers, Stack::kDraped}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const auto mat = form(small_plate(stack), seed).mat;
      EXPECT_NO_THROW(validate(mat, kFormedRoles, "mat"));
      for (const auto& layer : mat.layers) {
        for (const auto& s : layer.strands) {
          EXPECT_EQ(s.cx_mm, std::round(s.cx_mm * 1e6) / 1e6);
          EXPECT_EQ(s.length_mm, std::round(s.length_mm * 1e6) / 1e6);
          EXPECT_EQ(s.angle_deg, std::round(s.angle_deg.value() * 1e3) / 1e3);
        }
      }
    }
  }
}

// Strands of a layer, and their images, are as far apart as the clearance says; some are next to it.
TEST(FormPlate, StrandsKeepTheirGap) {
  auto layup = small_plate();
  layup.sequential.in_layer_gap_mm = 1.5;
  const auto mat = form(layup, 3).mat;
  double least = 1e9;
  for (const auto& layer : mat.layers) {
    for (std::size_t k = 0; k < layer.strands.size(); ++k) {
      for (std::size_t other = 0; other < k; ++other) {
        const auto a = outline(layer.strands[k], layer.strands[k].angle_deg.value());
        const auto b = outline(layer.strands[other], layer.strands[other].angle_deg.value());
        for (int i = -2; i <= 2; ++i) {
          for (int j = -2; j <= 2; ++j) least = std::min(least, distance_apart(a, b, 60 * i, 60 * j));
        }
      }
    }
  }
  EXPECT_GE(least, 1.5);
  EXPECT_LT(least, 1.8);
}

TEST(FormPlate, SameSeedSameBytesAndLayersAreIndependent) {
  std::set<std::string> texts;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto text = to_text(form(small_plate(), seed).mat);
    EXPECT_EQ(text, to_text(form(small_plate(), seed).mat));
    texts.insert(text);
  }
  EXPECT_EQ(texts.size(), 10U);
  auto fewer = small_plate();
  fewer.rows.resize(3);
  const auto low = form(fewer, 2).mat, high = form(small_plate(), 2).mat;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(low.layers[i].strands[0].cx_mm, high.layers[i].strands[0].cx_mm);
  EXPECT_NE(high.layers[0].strands[0].cx_mm, high.layers[1].strands[0].cx_mm);
}

// FNV-1a of the files of two mats: no compiler, flag or machine may move a digit.
TEST(FormPlate, SameMatOnEveryMachine) {
  const auto hash_of = [](const std::string& text) {
    std::uint64_t hash = 14695981039346656037U;
    for (const char ch : text) hash = (hash ^ static_cast<unsigned char>(ch)) * 1099511628211U;
    return hash;
  };
  auto layup = small_plate();
  layup.rows[0].angles = {0, 0, 0, 1.915};
  layup.rows[1].angles = {0, 90};
  layup.rows[2].fines = {{{14, 0, 6, 0}, 0.2}, {{8, 0, 4, 0}, {}}};
  EXPECT_EQ(hash_of(to_text(form(layup, 1).mat)), 1674570616431510744U);
  EXPECT_EQ(hash_of(to_text(form(small_plate(Stack::kDraped), 1).mat)), 17502636575444636521U);
}

// What a strand's place depends on its angle: with another drawn for each attempt the layer selects what fits.
TEST(FormPlate, PlacedStrandsAreBetterAlignedThanDrawnUnlessTheyKeepTheirAngle) {
  auto layup = small_plate();
  layup.rows.assign(300, {"surface", {40, 0, 8, 0}, {0, 0, 40}});
  layup.sequential.rsa_failures = 500;
  double drawn = 0, placed = 0;
  const auto measure = [&] {
    const auto formed = form(layup, 1);
    drawn = placed = 0;
    for (std::size_t i = 0; i < formed.drawn.size(); ++i) {
      drawn += formed.drawn[i].mean_off_mean_deg() / 300;
      placed += mean_off(0, formed.mat.layers[i]) / 300;
    }
  };
  measure();
  EXPECT_NEAR(drawn, 31.24, 0.5);
  EXPECT_LT(placed, drawn - 1);
  layup.sequential.keep_angle = true;
  measure();
  EXPECT_LT(std::abs(placed - drawn), 3);
}

// Fines fill what is left between the strands, or end at their share.
TEST(FormPlate, FinesFillUpOrEndAtTheirShare) {
  auto layup = small_plate();
  layup.rows.assign(20, {"core", {28, 0, 8, 0}, {0, 0, 25}});
  const auto area = [](const PlateMat& mat, double length) {
    double sum = 0;
    for (const auto& layer : mat.layers) {
      for (const auto& s : layer.strands) sum += s.length_mm == length ? s.length_mm * s.width_mm : 0;
    }
    return sum;
  };
  const double alone = area(form(layup, 1).mat, 28);
  for (auto& row : layup.rows) row.fines = {{{14, 0, 6, 0}, {}}};
  const auto filled = form(layup, 1).mat;
  EXPECT_EQ(area(filled, 28), alone);
  EXPECT_GT(area(filled, 14), 0.15 * alone);
  for (auto& row : layup.rows) row.fines = {{{14, 0, 6, 0}, 0.05}};
  const auto shared = form(layup, 1).mat;
  EXPECT_NEAR(area(shared, 14) / (area(shared, 14) + area(shared, 28)), 0.05, 0.04);  // a strand more in each layer
  EXPECT_LT(area(shared, 14), area(filled, 14) / 2);
  for (const auto& layer : filled.layers) {  // largest first
    EXPECT_TRUE(std::is_sorted(layer.strands.begin(), layer.strands.end(),
                               [](const auto& a, const auto& b) { return a.length_mm > b.length_mm; }));
  }
}

// A cut mat is a window of a larger one: strands end at its edges, in proportion as they would cross a line there.
TEST(FormPlate, CutMatsEndAtTheWindow) {
  PlateLayup layup;
  layup.length_mm = 60;
  layup.width_mm = 50;
  layup.sides = PlateSides::kCut;
  layup.rows = {{"surface", {150, 20, 25, 3}, {0}}, {"core", {150, 20, 25, 3}, {90}}};
  double surface_cover = 0;
  int ends_at_0 = 0, ends_at_length = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto mat = form(layup, seed).mat;
    EXPECT_NO_THROW(validate(mat, kFormedRoles, "mat"));
    surface_cover += coverage(mat, 0) / 40;
    for (const auto& s : mat.layers[0].strands) {
      ends_at_0 += std::abs(s.cx_mm - s.length_mm / 2) < 2e-6;
      ends_at_length += std::abs(s.cx_mm + s.length_mm / 2 - 60) < 2e-6;
    }
  }
  EXPECT_GT(surface_cover, 0.4);
  EXPECT_LT(surface_cover, 0.7);
  EXPECT_GT(ends_at_0, 20);
  EXPECT_GT(ends_at_length, 20);
}

// As many strands as cover the window once for each row of a block, in the blocks' order.
TEST(FormPlate, DrapedMatsHaveAsManyStrandsAsTheirRowsSay) {
  PlateLayup layup;
  layup.stack = Stack::kDraped;
  layup.drape_slopes = {0.05, 0.3};
  const PlateRow surface{"surface", {}, {0, 0, 25}}, core{"core", {}, {90, 0, 25}};
  layup.rows = {surface, surface, core, core, core, surface};
  const auto formed = form(layup, 1);
  const auto& mat = formed.mat;
  ASSERT_EQ(mat.layers.size(), 3U);
  EXPECT_EQ(mat.stack, Stack::kDraped);
  EXPECT_EQ(mat.drape_slopes, (std::array<double, 2>{0.05, 0.3}));
  EXPECT_EQ(mat.layers[1].role, "core");
  EXPECT_EQ(mat.layers[0].strands.size(), 34U);  // 2 x 254^2/3750 = 34.4
  EXPECT_EQ(mat.layers[1].strands.size(), 52U);  // 51.6
  EXPECT_EQ(mat.layers[2].strands.size(), 17U);  // 17.2
  EXPECT_EQ(formed.drawn[1].count, 52U);
  EXPECT_NEAR(formed.drawn[1].mean_off_mean_deg(), mean_off(90, mat.layers[1]), 1e-9);
}

// Half of the mass in strands of a quarter of the area: four of five strands.
TEST(FormPlate, FinesOfDrapedMatsAreDrawnByTheirNumber) {
  PlateLayup layup;
  layup.stack = Stack::kDraped;
  layup.rows.assign(60, {"core", {40, 0, 20, 0}, {}, {}, {{{20, 0, 10, 0}, 0.5}}});
  const auto mat = form(layup, 1).mat;
  const auto& strands = mat.layers[0].strands;
  const auto fines = static_cast<double>(
      std::count_if(strands.begin(), strands.end(), [](const auto& s) { return s.length_mm == 20; }));
  const auto n = static_cast<double>(strands.size());
  EXPECT_EQ(n, std::round(60 * 254 * 254 / (0.2 * 800 + 0.8 * 200)));
  EXPECT_NEAR(fines / n, 0.8, 3 * std::sqrt(0.16 / n));
}

struct BadPlateLayup {
  const char* name;
  void (*spoil)(PlateLayup&);
  std::vector<const char*> told;
};

class FormPlateRejects : public testing::TestWithParam<BadPlateLayup> {};

TEST_P(FormPlateRejects, WithOneClearMessage) {
  auto layup = small_plate();
  GetParam().spoil(layup);
  try {
    form(layup, 1);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    for (const auto* words : GetParam().told)
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Layups, FormPlateRejects,
    testing::Values(
        BadPlateLayup{"OwnImage",
                      [](PlateLayup& l) { l.rows[2].sizes = {}; },
                      {"row 3 (\"core\")", "150 x 25 mm at 90 degrees", "own image in a window of 60 x 60 mm",
                       "a window in which it never does, at any angle, is 152.3 x 152.3 mm"}},
        BadPlateLayup{"OwnImageAlongX",
                      [](PlateLayup& l) {
                        l.rows[0].sizes = {};
                        l.rows[0].angles = {0};
                      },
                      {"row 1", "at 0 degrees", "the least window is 150.2 x 25.2 mm"}},
        BadPlateLayup{"OwnImageAlongY",
                      [](PlateLayup& l) {
                        l.rows[0].sizes = {};
                        l.rows[0].angles = {90};
                      },
                      {"row 1", "at 90 degrees", "the least window is 25.2 x 150.2 mm"}},
        BadPlateLayup{"VeryLong", [](PlateLayup& l) { l.rows[0].sizes.length_mm = 1e8; }, {"row 1", "own image"}},
        BadPlateLayup{
            "LengthSd", [](PlateLayup& l) { l.rows[1].sizes.length_sd_mm = 41; }, {"row 2", "length_mm = 40 mm is 41"}},
        BadPlateLayup{
            "NegativeSd", [](PlateLayup& l) { l.rows[1].sizes.width_sd_mm = -1; }, {"row 2", "width_mm = 8 mm is -1"}},
        BadPlateLayup{"NoWidth", [](PlateLayup& l) { l.rows[1].sizes.width_mm = 0; }, {"row 2", "width_mm = 0 must"}},
        BadPlateLayup{
            "TwoDistributions", [](PlateLayup& l) { l.rows[1].angles.spread_deg = 3; }, {"row 2", "one distribution"}},
        BadPlateLayup{"NoWindow", [](PlateLayup& l) { l.width_mm = 0; }, {"width_mm = 0 must be between"}},
        BadPlateLayup{
            "NoFailures", [](PlateLayup& l) { l.sequential.rsa_failures = 0; }, {"rsa_failures = 0 must be 1 or more"}},
        BadPlateLayup{"NegativeGap",
                      [](PlateLayup& l) { l.sequential.in_layer_gap_mm = -1; },
                      {"in_layer_gap_mm = -1 must not be negative"}},
        BadPlateLayup{"CutAndTurned",
                      [](PlateLayup& l) { l.sides = PlateSides::kCut; },
                      {"row 1", "at 0 degrees, each at its own", "0 or 90 degrees"}},
        BadPlateLayup{"CutAtAnAngle",
                      [](PlateLayup& l) {
                        l.sides = PlateSides::kCut;
                        l.rows[0].angles = {45};
                      },
                      {"row 1", "strands at 45 degrees:", "0 or 90 degrees"}},
        BadPlateLayup{"CutAndDraped",
                      [](PlateLayup& l) {
                        l.sides = PlateSides::kCut;
                        l.stack = Stack::kDraped;
                      },
                      {"a draped mat has periodic sides"}},
        BadPlateLayup{"AllFines",
                      [](PlateLayup& l) {
                        l.rows[0].fines = {{{9, 0, 3, 0}, 1.0}};
                      },
                      {"row 1", "shares of fines by mass make 1"}},
        BadPlateLayup{"NoFines",
                      [](PlateLayup& l) {
                        l.rows[0].fines = {{{9, 0, 3, 0}, 0.0}};
                      },
                      {"row 1", "= 0 must be positive"}},
        BadPlateLayup{"AnyNumberOfDrapedFines",
                      [](PlateLayup& l) {
                        l.stack = Stack::kDraped;
                        l.rows[0].fines = {{{9, 0, 3, 0}, {}}};
                      },
                      {"row 1", "need a share by mass"}},
        BadPlateLayup{"OneSlope", [](PlateLayup& l) { l.drape_slopes = {0.1}; }, {"drape_slopes has 1 numbers"}},
        BadPlateLayup{"ManyStrands",
                      [](PlateLayup& l) { l.length_mm = l.width_mm = 5000; },
                      {"about 7.81e+04 strands a layer, more than 30000"}},
        BadPlateLayup{"NoRows", [](PlateLayup& l) { l.rows.clear(); }, {"no rows"}},
        BadPlateLayup{"NamelessKind", [](PlateLayup& l) { l.rows[0].kind = ""; }, {"row 1", "no name"}}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace strandlab::mat
