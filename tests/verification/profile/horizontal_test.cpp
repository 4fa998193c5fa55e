// Horizontal density distribution: maps of what is known, and the statistics of random mats (Dai & Steiner 1994).
#include "strandlab/profile/horizontal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "strandlab/mat/plate_form.hpp"
#include "support/report.hpp"

namespace strandlab::profile_tests {
namespace {

using profile::density_map, profile::poisson_variance, profile::variation;

constexpr double kWindow = 254, kLength = 150, kWidth = 25;  // mm

// A strand is one point: seen from above its outline is exact.
Panel<3> panel_of(mat::PlateMat mat) {
  mat.stack = mat::Stack::kLayers;  // heights do not matter here
  return make_panel(mat, {{"surface", wood::Material{}, 0}}, 1e3, 1);
}

mat::PlateLayup layup(mat::Stack stack, double angle_sd_deg, int rows) {
  mat::PlateLayup layup;
  layup.length_mm = layup.width_mm = kWindow;
  layup.stack = stack;
  mat::PlateRow row;
  row.kind = "surface";
  row.sizes = {kLength, 0, kWidth, 0};
  row.angles.sd_deg = angle_sd_deg;
  layup.rows.assign(static_cast<std::size_t>(rows), row);
  return layup;
}

TEST(DensityMap, CutsStrandsExactly) {
  mat::PlateMat mat;
  mat.length_mm = mat.width_mm = 10;
  mat.layer_thickness_mm = 0.8;
  auto& layer = mat.layers.emplace_back();
  layer.role = "surface";
  layer.strands.push_back({9, 5, 5, 1, 0.0, {}, {}});         // x 6.5..11.5, y 4.5..5.5: over the edge at 10
  layer.strands.push_back({3, 1, 2.83, 2.83, 45.0, {}, {}});  // a square on its corner, over the edge at 0
  const auto panel = panel_of(mat);
  const auto map = density_map(panel, 1);
  const double wood = wood::Material{}.density_kg_m3;
  EXPECT_NEAR(map.at(7, 4), wood / 2, 1e-9);
  EXPECT_NEAR(map.at(6, 5), wood / 4, 1e-9);
  EXPECT_NEAR(map.at(1, 4), wood / 4, 1e-9);  // its image
  EXPECT_NEAR(map.at(2, 0), wood, 1e-9);
  EXPECT_NEAR(map.at(2, 9), map.at(3, 9), 1e-9);  // the square's corner below the edge
  const double mean = std::accumulate(map.kg_m3.begin(), map.kg_m3.end(), 0.0) / 100;
  report("density map of two strands, mean over mass over volume", mean / (wood * (5 + 2.83 * 2.83) / 100),
         near(1, 1e-12).because("round-off"));
  EXPECT_NEAR(profile::void_fraction(panel), 1 - (5 + 2.83 * 2.83) / 100, 1e-12);
}

TEST(PoissonVariance, HasItsCheckValues) {
  // An independent program, strands of 150 x 25 mm.
  for (const auto& [zone, value] :
       {std::pair{1.0, 0.98447}, {5.0, 0.92296}, {10.0, 0.84741}, {25.4, 0.62401}, {50.0, 0.37037}, {100.0, 0.17824}})
    EXPECT_NEAR(poisson_variance(zone, kLength, kWidth), value, 6e-6) << zone;
}

// Strands laid anywhere: the variance of zones over the mean squared is V(D)/mu, less L B/window, since every mat has
// the same number of strands. The standard error over 100 mats is about .03.
TEST(HorizontalDensity, OfDrapedMatsIsThatOfPoissonStatistics) {
  constexpr int kMats = 100, kRows = 20;
  constexpr double kCell = 5;
  for (const double sd : {0.0, 25.0}) {
    std::map<int, double> square;  // by cells of a zone
    double cell = 0;
    for (std::uint64_t seed = 1; seed <= kMats; ++seed) {
      const auto map = density_map(panel_of(mat::form(layup(mat::Stack::kDraped, sd, kRows), seed).mat), kCell);
      cell = map.cell_x_mm;
      for (const int cells : {2, 10}) square[cells] += std::pow(variation(map, cells), 2) / kMats;
    }
    for (const auto& [cells, found] : square) {
      const double expected =
          (poisson_variance(cells * cell, kLength, kWidth) - kLength * kWidth / (kWindow * kWindow)) / kRows;
      report("draped mats, angle sd " + std::to_string(static_cast<int>(sd)) + ", variance of zones of " +
                 std::to_string(static_cast<int>(std::lround(cells * cell))) + " mm over that of Poisson statistics",
             found / expected, near(1, 0.1));
    }
  }
}

// Strands of a layer keep apart: over a point they are binomial, and vary less than strands laid anywhere.
TEST(HorizontalDensity, OfLayersIsBelowThatOfPoissonStatistics) {
  constexpr int kRows = 20;
  constexpr double kCell = 2;
  const auto mat = mat::form(layup(mat::Stack::kLayers, 25, kRows), 1).mat;
  double covered = 0;
  for (std::size_t i = 0; i < mat.layers.size(); ++i) covered += mat::coverage(mat, i) / kRows;
  const double found = std::pow(variation(density_map(panel_of(mat), kCell), 1), 2);
  const double point = (1 - covered) / (covered * kRows), poisson = 1 / (covered * kRows);
  report("layers of strands that do not overlap, variance of 2 mm zones over that of independent layers at a point",
         found / point, near(1, 0.15));
  EXPECT_LT(found, 0.7 * poisson);
}

}  // namespace
}  // namespace strandlab::profile_tests
