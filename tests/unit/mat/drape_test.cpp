#include "strandlab/mat/drape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "strandlab/mat/plate_form.hpp"

namespace strandlab::mat {
namespace {

const std::vector<RoleAngle> kDrapedRoles{{"surface", 0}};
constexpr double kThickness = 0.8, kCell = 0.5;

PlateMat draped(std::vector<PlateStrand> strands, double slope_along, double slope_across) {
  PlateMat mat;
  mat.length_mm = 100;
  mat.width_mm = 60;
  mat.layer_thickness_mm = kThickness;
  mat.stack = Stack::kDraped;
  mat.drape_slopes = {slope_along, slope_across};
  mat.layers = {{"surface", std::move(strands), {}, {}}};
  return mat;
}

// A strand across another is bent over it: a thickness high above it, then falling with its slope along, and flat on
// the floor. Half a cell of the lattice is what the raster of the surface may add to a width.
TEST(Drape, AStrandFallsFromWhatItCrossesWithItsSlope) {
  constexpr double kSlope = 0.1;
  const auto result =
      drape(draped({{50, 30, 50, 10, 90, {}, {}}, {50, 30, 60, 8, 0, {}, {}}}, kSlope, 0.2), kDrapedRoles, kCell);
  const auto& below = result.layers[0][0];
  EXPECT_EQ(*std::max_element(below.lower_mm.begin(), below.lower_mm.end()), 0);
  const auto& over = result.layers[0][1];
  ASSERT_EQ(over.along, 120U);
  ASSERT_EQ(over.across, 16U);
  for (std::size_t j = 0; j <= over.across; ++j) {
    for (std::size_t i = 0; i <= over.along; ++i) {
      const double u = std::abs(static_cast<double>(i) * kCell - 30);
      const double expected = std::clamp(kThickness - kSlope * (u - 5), 0.0, kThickness);
      EXPECT_NEAR(over.at(i, j), expected, kSlope * kCell / 2 + 1e-12) << i << " " << j;
    }
  }
  EXPECT_NEAR(result.highest_mm, 2 * kThickness, 1e-12);
}

// The same of a strand that lies along the edge of another: it falls with its slope across. Both at 30 degrees, and
// over the edge of the window.
TEST(Drape, AStrandFallsAcrossWithItsOtherSlopeAlsoBeyondTheWindow) {
  constexpr double kSlope = 0.2;
  const double c = std::cos(M_PI / 6), s = 0.5;
  const auto result =
      drape(draped({{98, 2, 40, 6, 30, {}, {}}, {98 - 5 * s, 2 + 5 * c, 20, 16, 30, {}, {}}}, 0.1, kSlope),
            kDrapedRoles, kCell);
  const auto& over = result.layers[0][1];  // from 3 mm below the middle of the other to 13 mm above it
  for (std::size_t j = 0; j <= over.across; ++j) {
    const double v = static_cast<double>(j) * kCell - 8 + 5;  // from the middle line of the lower strand
    const double expected = std::clamp(kThickness - kSlope * (v - 3), 0.0, kThickness);
    EXPECT_NEAR(over.at(20, j), expected, kSlope * kCell + 1e-9) << v;
  }
}

// Without slopes a strand is flat, as high as the highest point below it.
TEST(Drape, FlatStrandsLieOnTheHighestPoint) {
  const auto result = drape(draped({{20, 30, 10, 10, 0, {}, {}},
                                    {24, 30, 10, 10, 0, {}, {}},
                                    {70, 30, 30, 10, 0, {}, {}},
                                    {45, 30, 80, 4, 0, {}, {}}},
                                   0, 0),
                            kDrapedRoles, kCell);
  for (const double z : result.layers[0][3].lower_mm) EXPECT_NEAR(z, 2 * kThickness, 1e-12);
  EXPECT_LT(result.touching, 0.9);
}

// Heights of a random mat: slopes within their limits and often at them, part of the faces on what lies below.
TEST(Drape, BendsRandomMatsWithinItsSlopes) {
  PlateLayup layup;
  layup.length_mm = layup.width_mm = 60;
  layup.stack = Stack::kDraped;
  layup.rows.assign(6, {"surface", {40, 0, 8, 0}, {0, 0, 25}});
  const auto mat = form(layup, 1).mat;
  const auto result = drape(mat, kDrapedRoles, 1);
  int leaning = 0, corners = 0;
  for (const auto& strand : result.layers[0]) {
    const double along = 0.1 * 40 / 40 * 1.0000001, across = 0.2 * 8 / 8 * 1.0000001;
    for (std::size_t j = 0; j <= strand.across; ++j) {
      for (std::size_t i = 0; i <= strand.along; ++i, ++corners) {
        EXPECT_GE(strand.at(i, j), 0);
        if (i > 0) {
          EXPECT_LE(std::abs(strand.at(i, j) - strand.at(i - 1, j)), along);
          leaning += std::abs(strand.at(i, j) - strand.at(i - 1, j)) > 0.99 * along;
        }
        if (j > 0) {
          EXPECT_LE(std::abs(strand.at(i, j) - strand.at(i, j - 1)), across);
        }
      }
    }
  }
  EXPECT_GT(leaning, corners / 4);
  EXPECT_GT(result.touching, 0.2);
  EXPECT_LT(result.touching, 0.8);
  EXPECT_LT(result.mean_top_mm, result.highest_mm);
  EXPECT_GT(result.mean_top_mm, coverage(mat, 0) * kThickness);  // more than the wood alone
}

// Strands in the order of the file: the first lies on the floor whatever comes after.
TEST(Drape, LaterStrandsLieOnEarlierOnes) {
  const PlateStrand a{50, 30, 40, 10, 0, {}, {}}, b{50, 30, 40, 10, 90, {}, {}};
  const auto ab = drape(draped({a, b}, 0.1, 0.2), kDrapedRoles, kCell),
             ba = drape(draped({b, a}, 0.1, 0.2), kDrapedRoles, kCell);
  EXPECT_EQ(ab.layers[0][0].lower_mm[0], 0);
  EXPECT_EQ(ba.layers[0][0].lower_mm[0], 0);
  EXPECT_GT(ab.layers[0][1].at(40, 10), 0.7);
  EXPECT_EQ(ab.layers[0][1].lower_mm, ba.layers[0][1].lower_mm);
}

}  // namespace
}  // namespace strandlab::mat
