#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "strandlab/core/error.hpp"
#include "strandlab/glue/glue.hpp"

namespace strandlab::glue {
namespace {

struct Piece {
  int row;
  double x0, x1;
};

// Strands of poplar, 0.8 mm thick, in a window of 20 mm.
Panel<2> panel_of(const std::vector<Piece>& pieces) {
  mat::Mat mat;
  mat.length_mm = 20;
  mat.layer_thickness_mm = 0.8;
  for (const auto& piece : pieces) {
    while (static_cast<int>(mat.layers.size()) <= piece.row) mat.layers.emplace_back().role = "surface";
    mat::Strand strand;
    strand.x0_mm = piece.x0;
    strand.x1_mm = piece.x1;
    mat.layers[piece.row].strands.push_back(strand);
  }
  return make_panel(mat, {{"surface", wood::Material{}, 0}}, 0.8 / 6, 6);
}

void raise(Strand<2>& strand, double dy) {
  for (auto& x : strand.points.x) x[1] += dy;
}

double glued_length(const std::vector<GluePoint<2>>& points) {
  double sum = 0;
  for (const auto& p : points) sum += p.area;
  return sum;
}

// Two strands that overlap from 7.13 to 12.41 mm: a glue line of that length, points at both ends, normal upward.
TEST(Cure, GluesWhatFacesEachOther) {
  const auto points = cure(panel_of({{0, 0, 12.41}, {1, 7.13, 20}}), {});
  ASSERT_GT(points.size(), 2U);
  EXPECT_NEAR(glued_length(points), 12.41 - 7.13, 1e-9);
  EXPECT_NEAR(points.front().a.position[0], 7.13, 1e-9);
  EXPECT_NEAR(points.back().a.position[0], 12.41, 1e-9);
  for (const auto& p : points) {
    EXPECT_EQ(p.a.strand, 0);
    EXPECT_EQ(p.b.strand, 1);
    EXPECT_EQ(p.a.face, StrandFace::kTop);
    EXPECT_EQ(p.b.face, StrandFace::kBottom);
    EXPECT_NEAR((p.normal - Vec<2>(0, 1)).norm(), 0, 1e-12);
    EXPECT_NEAR((p.b.position - p.a.position).norm(), 0, 1e-9);
    EXPECT_NEAR(p.a.position[1], 0.8, 1e-9);
    EXPECT_NEAR(p.gap, 0, 1e-9);
  }
}

// Strands whose resins have come to half and to a tenth of their strength: a bond of the mean, .3. Where the mean is
// below .05 there is none.
TEST(Cure, GivesBondsTheQualityOfTheirResins) {
  auto panel = panel_of({{0, 0, 12.41}, {1, 7.13, 20}});
  for (const auto& p : cure(panel, {})) EXPECT_EQ(p.quality, 1);
  panel.strands[0].points.bond_quality.assign(panel.strands[0].size(), .5);
  panel.strands[1].points.bond_quality.assign(panel.strands[1].size(), .1);
  const auto points = cure(panel, {});
  EXPECT_NEAR(glued_length(points), 12.41 - 7.13, 1e-9);
  for (const auto& p : points) EXPECT_DOUBLE_EQ(p.quality, .3);
  for (auto& strand : panel.strands) strand.points.bond_quality.assign(strand.size(), .04);
  EXPECT_TRUE(cure(panel, {}).empty());
}

// The interpolation leads back to the position: corners segment and segment + 1 of the face, weights 1 - xi and xi.
TEST(Cure, GivesTheInterpolationOnBothFaces) {
  const auto panel = panel_of({{0, 0, 12.41}, {1, 7.13, 20}});
  for (const auto& p : cure(panel, {})) {
    for (const auto* side : {&p.a, &p.b}) {
      const auto& strand = panel.strands[side->strand];
      const auto at = corners(strand);
      const int row = side->face == StrandFace::kTop ? strand.lattice.counts[1] : 0;
      const auto corner = strand.lattice.corner({side->segment, row});
      const Vec<2> position = (1 - side->xi) * at[corner] + side->xi * at[corner + 1];
      EXPECT_NEAR((position - side->position).norm(), 0, 1e-12);
      EXPECT_GE(side->xi, 0);
      EXPECT_LE(side->xi, 1);
    }
  }
}

TEST(Cure, LeavesOpenWhatIsFurtherApartThanTheCuringGap) {
  auto panel = panel_of({{0, 0, 20}, {1, 0, 20}});
  raise(panel.strands[1], 0.09);
  const auto points = cure(panel, {});
  EXPECT_NEAR(glued_length(points), 20, 1e-9);
  EXPECT_NEAR(points.front().gap, 0.09, 1e-9);
  raise(panel.strands[1], 0.02);
  EXPECT_TRUE(cure(panel, {}).empty());
  CuringOptions wider;
  wider.max_gap_mm = 0.2;
  EXPECT_NEAR(glued_length(cure(panel, wider)), 20, 1e-9);
}

// Faces that overlap a little, as pressing leaves them, are in contact.
TEST(Cure, GluesFacesThatOverlap) {
  auto panel = panel_of({{0, 0, 20}, {1, 0, 20}});
  raise(panel.strands[1], -0.15);
  EXPECT_NEAR(glued_length(cure(panel, {})), 20, 1e-9);
}

// A wedge-shaped gap 0.02 x: open from x = 5 mm on. The end lies where the gap is max_gap, not at a material point.
TEST(Cure, EndsAGlueLineWhereTheGapOpens) {
  auto panel = panel_of({{0, 0, 20}, {1, 0, 20}});
  for (auto& x : panel.strands[1].points.x) x[1] += 0.02 * x[0];
  for (auto& F : panel.strands[1].points.F) F(1, 0) = 0.02;
  const auto points = cure(panel, {});
  EXPECT_NEAR(points.back().gap, 0.1, 1e-6);
  EXPECT_NEAR(points.back().a.position[0], 5, 0.01);
}

// Strands end to end in one row do not bond, nor do rows with a strand between them; a gap in the middle row bonds
// nothing either until the outer rows meet in it.
TEST(Cure, BondsFacesOnly) {
  EXPECT_TRUE(cure(panel_of({{0, 0, 10}, {0, 10, 20}}), {}).empty());
  auto panel = panel_of({{0, 0, 20}, {1, 0, 8}, {1, 12, 20}, {2, 0, 20}});
  for (const auto& p : cure(panel, {})) EXPECT_EQ(panel.strands[p.b.strand].row, panel.strands[p.a.strand].row + 1);
  raise(panel.strands[3], -0.75);
  double across = 0;
  for (const auto& p : cure(panel, {})) across += p.a.strand == 0 && p.b.strand == 3 ? p.area : 0;
  EXPECT_GT(across, 3.9);
}

// Glue reaches the nearest strand only, however far it may reach: three rows of 0.8 mm with a curing gap of 1 mm have
// two glue lines of 20 mm, none through the middle row. Where that has a gap of 4 mm the outer rows are glued, once.
TEST(Cure, NeverGluesThroughAStrand) {
  CuringOptions wide;
  wide.max_gap_mm = 1;
  EXPECT_NEAR(glued_length(cure(panel_of({{0, 0, 20}, {1, 0, 20}, {2, 0, 20}}), wide)), 40, 1e-9);
  const auto points = cure(panel_of({{0, 0, 20}, {1, 0, 8}, {1, 12, 20}, {2, 0, 20}}), wide);
  double across = 0;
  for (const auto& p : points) across += p.a.strand == 0 && p.b.strand == 3 ? p.area : 0;
  EXPECT_NEAR(across, 4, 1e-6);
  EXPECT_NEAR(glued_length(points), 16 + 4 + 16, 1e-6);
}

// As pressing leaves them: the middle row overlaps both neighbours by a quarter of its thickness.
TEST(Cure, NeverGluesThroughAStrandThatOverlaps) {
  auto panel = panel_of({{0, 0, 20}, {1, 0, 20}, {2, 0, 20}});
  raise(panel.strands[0], 0.2);
  raise(panel.strands[2], -0.2);
  CuringOptions wide;
  wide.max_gap_mm = 1;
  EXPECT_NEAR(glued_length(cure(panel, wide)), 40, 1e-9);
}

// Two strands as near to a third, as where the press pushed one's end through the other's: each place of the third has
// glue for one of them, the one of the lower number.
TEST(Cure, GluesAPlaceOnceOnly) {
  auto panel = panel_of({{0, 0, 20}, {1, 0, 12}, {1, 12, 20}});
  for (auto& x : panel.strands[2].points.x) x[0] -= 4;
  double with_first = 0;
  const auto points = cure(panel, {});
  for (const auto& p : points) with_first += p.b.strand == 1 ? p.area : 0;
  EXPECT_NEAR(with_first, 12, 1e-6);
  EXPECT_NEAR(glued_length(points), 16, 1e-6);
}

// A strand that stands on the one below by a corner: faces bond where their outward normals are more than 120 degrees
// apart, here 130 and 110.
TEST(Cure, BondsFacesThatLookAtEachOther) {
  CuringOptions wide;
  wide.max_gap_mm = 0.3;
  for (const double angle_deg : {50.0, 70.0}) {
    auto panel = panel_of({{0, 0, 20}, {1, 5, 9}});
    const double c = std::cos(angle_deg * M_PI / 180), s = std::sin(angle_deg * M_PI / 180);
    Tensor<2> turn;
    turn << c, -s, s, c;
    const Vec<2> corner(5, 0.8);
    auto& points = panel.strands[1].points;
    for (auto& x : points.x) x = corner + turn * (x - corner);
    for (auto& F : points.F) F = turn * F;
    const double glued = glued_length(cure(panel, wide));
    EXPECT_EQ(glued > 0.05, angle_deg < 60) << glued << " mm at " << angle_deg;
  }
}

// On y = A sin(2 pi x/w) the normal is that of the curve and the areas sum up to its length.
TEST(Cure, FollowsAnUndulatedLine) {
  auto panel = panel_of({{0, 0, 20}, {1, 0, 20}});
  const double amplitude = 0.25, k = 2 * M_PI / 5;
  for (auto& strand : panel.strands) {
    for (std::size_t p = 0; p < strand.size(); ++p) {
      const double x = strand.points.x[p][0];
      strand.points.x[p][1] += amplitude * std::sin(k * x);
      strand.points.F[p](1, 0) = amplitude * k * std::cos(k * x);
    }
  }
  double length = 0;
  for (int i = 0; i < 100000; ++i) length += 2e-4 * std::hypot(1, amplitude * k * std::cos(k * 2e-4 * (i + 0.5)));
  const auto points = cure(panel, {});
  EXPECT_NEAR(glued_length(points) / length, 1, 1e-3);
  for (const auto& p : points) {
    const double slope = amplitude * k * std::cos(k * p.a.position[0]);
    EXPECT_NEAR((p.normal - Vec<2>(-slope, 1).normalized()).norm(), 0, 0.03);
    EXPECT_NEAR(p.normal.norm(), 1, 1e-12);
    EXPECT_LT(std::abs(p.gap), 2e-3);
  }
}

// One constraint per point and no more points than the coarser of the faces has corners.
TEST(Cure, SpacesPointsEvenlyAsAsked) {
  CuringOptions options;
  options.point_spacing_mm = 0.4;
  const auto points = cure(panel_of({{0, 0, 20}, {1, 0, 20}}), options);
  ASSERT_EQ(points.size(), 51U);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(points[i].a.position[0], 0.4 * static_cast<double>(i), 1e-9);
    EXPECT_NEAR(points[i].area, i == 0 || i == 50 ? 0.2 : 0.4, 1e-9);
  }
}

TEST(Cure, RejectsOptionsThatMeanNothing) {
  const auto panel = panel_of({{0, 0, 20}, {1, 0, 20}});
  for (const double gap : {0.0, -0.1, std::nan(""), std::numeric_limits<double>::infinity()}) {
    CuringOptions options;
    options.max_gap_mm = gap;
    EXPECT_THROW(cure(panel, options), InputError) << gap;
  }
  CuringOptions options;
  options.point_spacing_mm = -1;
  EXPECT_THROW(cure(panel, options), InputError);
}

// Three rows: the top face of the top row and the bottom face of the bottom row have nothing to face.
TEST(FacingLength, CountsTheInnerFaces) {
  EXPECT_NEAR(facing_length(panel_of({{0, 0, 20}, {1, 2, 12}, {2, 5, 20}})), 20 + 2 * 10 + 15, 1e-9);
}

}  // namespace
}  // namespace strandlab::glue
