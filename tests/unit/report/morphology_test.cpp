#include "strandlab/report/morphology.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "synthetic_panel.hpp"

namespace strandlab::report {
namespace {

using test::deform;
using test::flat_strand;
using test::panel_of;

constexpr double kExact = 1e-12;  // fractions; the geometry is exact up to round-off

// Every material line (x, y) -> (x, y + slope x): vertical shear.
void shear_up(Strand<2>& strand, double slope) {
  deform(
      strand, [slope](const Vec<2>& x) { return Vec<2>(x[0], x[1] + slope * x[0]); },
      [slope](const Vec<2>&) {
        return Tensor<2>{{1, 0}, {slope, 1}};
      });
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// 4 x 1 and 3 x 1 mm, common 2 x 0.25 mm, in a window of 10 x 4 mm, on lattices that do not match.
TEST(Areas, TwoOverlappingRectangles) {
  const auto a = areas(panel_of({flat_strand(0, 4, 0, 1, 13, 3), flat_strand(2, 5, 0.75, 1.75, 7, 4)}, 10, 4));
  EXPECT_NEAR(a.overlap, 0.5 / 40, kExact);
  EXPECT_NEAR(a.largest_overlap, 0.5 / 40, kExact);
  EXPECT_EQ(a.overlap_a, 0);
  EXPECT_EQ(a.overlap_b, 1);
  EXPECT_NEAR(a.strands, 7.0 / 40, kExact);
  EXPECT_NEAR(a.void_fraction(), 1 - 6.5 / 40, kExact);
  EXPECT_NEAR(a.outside, 0, kExact);
}

// A strand sheared to the slope 0.05 dips into a flat one, whose top is at 1: its bottom face 0.8 + 0.05 x is below 1
// up to x = 4, a triangle of 4 x 0.2 / 2 mm^2.
TEST(Areas, ShearedStrandDipsIntoAFlatOne) {
  auto tilted = flat_strand(0, 10, 0.8, 1.6, 37, 6);
  shear_up(tilted, 0.05);
  const auto a = areas(panel_of({flat_strand(0, 10, 0, 1, 50, 6), tilted}, 10, 3));
  EXPECT_NEAR(a.overlap, 0.4 / 30, kExact);
  EXPECT_NEAR(a.void_fraction(), 1 - (10 + 8 - 0.4) / 30, kExact);
}

// Three pairs; the largest is that of the strands 1 and 2: 4 x 0.3 mm.
TEST(Areas, LargestOverlapNamesItsPair) {
  const auto a = areas(panel_of({flat_strand(0, 6, 0, 1, 20, 3), flat_strand(5, 10, 0.9, 1.9, 20, 3),
                                 flat_strand(6, 10, 1.6, 2.6, 20, 3), flat_strand(0, 5.5, 1.5, 2.5, 20, 3)},
                                10, 4));
  EXPECT_NEAR(a.overlap, (1 * 0.1 + 4 * 0.3 + 0.5 * 0.4) / 40, kExact);
  EXPECT_NEAR(a.largest_overlap, 1.2 / 40, kExact);
  EXPECT_EQ(a.overlap_a, 1);
  EXPECT_EQ(a.overlap_b, 2);
}

TEST(Areas, StrandsThatTouchDoNotOverlap) {
  const auto a = areas(panel_of({flat_strand(0, 10, 0, 1, 31, 3), flat_strand(0, 10, 1, 2, 17, 3)}, 10, 2));
  EXPECT_NEAR(a.overlap, 0, kExact);
  EXPECT_NEAR(a.void_fraction(), 0, kExact);
}

// 0.5 mm beyond the end of the window and 0.1 mm into the top platen, of a strand of 10 x 1 mm.
TEST(Areas, WhatSticksOutIsReported) {
  const auto a = areas(panel_of({flat_strand(0.5, 10.5, 1.1, 2.1, 40, 6)}, 10, 2));
  EXPECT_NEAR(a.strands, 9.5 * 0.9 / 20, kExact);
  EXPECT_NEAR(a.outside, (10 - 9.5 * 0.9) / 20, kExact);
}

// Four elements of 1 mm in a square; one is stretched along a diagonal so far that it pushes the corner they share to
// (1/4, 1/4) of the element opposite, which is then not convex, and its own outer corner to (5, 5). The outline is
// (0,0) (2,0) (2,1) (5,5) (1,2) (0,2): 7 mm^2 by the shoelace formula. Every corner gets its turn.
TEST(Areas, ElementThatIsNotConvex) {
  for (std::size_t stretched = 0; stretched < 4; ++stretched) {
    auto strand = flat_strand(4, 6, 4, 6, 2, 2);
    const double side = stretched == 0 || stretched == 3 ? 1 : -1;
    strand.points.F[stretched] += 3 * Tensor<2>{{1, side}, {side, 1}};
    const auto a = areas(panel_of({strand, flat_strand(0, 10, 0, 10, 9, 5)}, 10, 10));
    EXPECT_NEAR(a.overlap, 7.0 / 100, kExact) << "element " << stretched;
  }
}

// The void between two rows is that of the mat: gap area over panel area, whatever smooth map moves both alike. The map
// (x, y) -> (x, (y + A sin kx)(1 - C)) keeps rows in contact; corners of rows with different lattices lie on the same
// curve up to the square of the spacing.
TEST(Areas, PressedAlikeKeepsSolidFraction) {
  auto panel = test::reference_panel("osb_s1");
  const double solid = 1 - areas(panel).void_fraction();
  test::undulate(panel, 0.2, 12);
  test::compact(panel, 0.3);
  const auto a = areas(panel);
  EXPECT_LT(a.overlap, 2e-5);
  EXPECT_NEAR(a.strands, solid, 0.01);  // the waves change areas a little where strands end
  EXPECT_NEAR(a.strands + a.void_fraction() - a.overlap, 1, kExact);
}

TEST(Histogram, SharesByWeight) {
  const auto h = histogram("q", {0.1, 0.6, 0.7, -5, 9}, {1, 2, 3, 4, 10}, 0, 1, 2);
  ASSERT_EQ(h.edges, (std::vector<double>{0, 0.5, 1}));
  EXPECT_NEAR(h.fraction[0], 5.0 / 20, kExact);  // 0.1, and -5 in the first bin
  EXPECT_NEAR(h.fraction[1], 15.0 / 20, kExact);
  EXPECT_NEAR(h.mean, (0.1 + 1.2 + 2.1 - 20 + 90) / 20, kExact);
  EXPECT_EQ(h.lowest, -5);
  EXPECT_EQ(h.highest, 9);
  EXPECT_THROW(histogram("q", {}, {}, 0, 1, 0), std::invalid_argument);
  EXPECT_THROW(histogram("q", {}, {}, 1, 1, 5), std::invalid_argument);
}

// Vertical shear by tan 10 degrees turns the grain by 10 degrees and thins the strand, at constant area, by cos 10
// degrees.
TEST(Histogram, ShearedStrandTurnsAndThins) {
  const double angle = 10 * std::numbers::pi / 180;
  auto strand = flat_strand(0, 10, 0, 0.8, 40, 6);
  shear_up(strand, std::tan(angle));
  const auto panel = panel_of({strand, flat_strand(0, 30, 4, 4.8, 100, 6)}, 30, 6);
  const auto angles = grain_angle_histogram(panel);
  EXPECT_NEAR(sum(angles.fraction), 1, kExact);
  EXPECT_NEAR(angles.mean, 2.5, 1e-9);  // a quarter of the wood at 10 degrees
  EXPECT_NEAR(angles.sd, std::sqrt(0.25 * 0.75) * 10, 1e-9);
  EXPECT_NEAR(angles.fraction[100], 0.25, kExact);  // 9.5..10.5
  EXPECT_NEAR(angles.fraction[90], 0.75, kExact);   // -0.5..0.5
  const auto strains = thickness_strain_histogram(panel);
  EXPECT_NEAR(strains.lowest, std::cos(angle) - 1, 1e-12);
  EXPECT_NEAR(strains.mean, (std::cos(angle) - 1) / 4, 1e-12);
  EXPECT_NEAR(strains.highest, 0, 1e-12);
}

// Turning a strand as a whole leaves its thickness; pressing it to 60 % of its height is a thickness strain of -0.4.
TEST(Histogram, ThicknessStrainIsThatOfTheStrandNotOfThePanel) {
  auto panel = panel_of({flat_strand(0, 10, 0, 0.8, 40, 6)}, 10, 0.8);
  test::compact(panel, 0.4);
  EXPECT_NEAR(thickness_strain_histogram(panel).mean, -0.4, 1e-12);
  const double c = std::cos(0.3), s = std::sin(0.3);
  const Tensor<2> turn{{c, -s}, {s, c}};
  deform(
      panel.strands[0], [&](const Vec<2>& x) { return Vec<2>(turn * x); }, [&](const Vec<2>&) { return turn; });
  EXPECT_NEAR(thickness_strain_histogram(panel).mean, -0.4, 1e-12);
  EXPECT_NEAR(grain_angle_histogram(panel).mean, 0.3 * 180 / std::numbers::pi, 1e-9);
}

// Waves y += A sin(kx): the steepest grain is atan(A k).
TEST(Histogram, SteepestGrainOfWaves) {
  auto panel = panel_of({flat_strand(0, 24, 3.8, 4.2, 400, 2)}, 24, 8);
  test::undulate(panel, 0.5, 12);
  const double steepest = std::atan(0.5 * 2 * std::numbers::pi / 12) * 180 / std::numbers::pi;
  const auto h = grain_angle_histogram(panel);
  EXPECT_NEAR(h.highest, steepest, 0.05);  // the points miss the flanks by half a spacing, and sin(pi y/h) is 0.997
  EXPECT_NEAR(h.lowest, -steepest, 0.05);
  EXPECT_NEAR(h.mean, 0, 1e-9);
}

// A state is named by the compaction that was asked for, in every table; what was reached stands beside it once.
TEST(Morphology, TablesHoldEveryState) {
  auto panel = panel_of({flat_strand(0, 4, 0, 1, 13, 3), flat_strand(2, 5, 0.75, 1.75, 7, 4)}, 10, 4);
  const auto before = morphology(panel, 0);
  panel.top_mm = 3;
  const auto after = morphology(panel, 0.2);
  const auto summary = morphology_table({before, after});
  EXPECT_EQ(summary.columns().size(), 14U);
  EXPECT_EQ(summary.rows(), 2U);
  EXPECT_EQ(summary.columns()[6], "grain_angle_mean_deg");
  EXPECT_EQ(summary.columns()[10], "strand_thickness_strain_mean");
  EXPECT_NE(summary.text().find("\n0.2,0.25,"), std::string::npos);
  const auto bins = histogram_table({before, after});
  EXPECT_EQ(bins.rows(), 2U * (181U + 96U));
  EXPECT_NE(bins.text().find("\n0.2,"), std::string::npos);
  EXPECT_NE(bins.text().find("0,grain_angle_deg,-0.5,0.5,1\n"), std::string::npos);
}

}  // namespace
}  // namespace strandlab::report
