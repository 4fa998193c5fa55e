#include "strandlab/profile/profile.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "strandlab/core/error.hpp"
#include "strandlab/profile/domain.hpp"

namespace strandlab::profile {
namespace {

// Length or area of the part of a convex polygon (its corners in turn) below a height: shoelace of the cut polygon.
double area_below(const std::vector<Vec<2>>& polygon, double y) {
  std::vector<Vec<2>> cut;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (a[1] <= y) cut.push_back(a);
    if ((a[1] <= y) != (b[1] <= y)) cut.emplace_back(a + (y - a[1]) / (b[1] - a[1]) * (b - a));
  }
  double twice = 0;
  for (std::size_t i = 0; i < cut.size(); ++i) {
    const Vec<2>&a = cut[i], &b = cut[(i + 1) % cut.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return std::abs(twice) / 2;
}

// The closed form against clipping the parallelogram as a polygon, for many shapes and heights.
TEST(Domain, PartOfAParallelogramIsThatOfTheClippedPolygon) {
  for (int i = 0; i < 40; ++i) {
    const double turn = 0.3 * i;
    Tensor<2> F;
    F << std::cos(turn), -0.5 * std::sin(turn), std::sin(turn), 0.5 * std::cos(turn) + 0.2;
    if (std::abs(F.determinant()) < 0.01) continue;
    const Vec<2> spacing(0.3, 0.13), a = 0.5 * spacing[0] * F.col(0), b = 0.5 * spacing[1] * F.col(1);
    const std::vector<Vec<2>> polygon{-a - b, a - b, a + b, b - a};
    const double whole = spacing.prod() * std::abs(F.determinant());
    const auto spans = heights<2>(F, spacing);
    for (double y = -0.3; y < 0.3; y += 0.011)
      EXPECT_NEAR(part_below<2>(spans, y), area_below(polygon, y) / whole, 1e-12) << "turn " << turn << ", y " << y;
  }
}

// A cube on its corner: below a plane at height z over the corner lies a pyramid whose three edges have length sqrt(3)
// z, volume (sqrt(3) z)^3/6, as long as z is below the next corners at 1/sqrt(3).
TEST(Domain, PartOfACubeOnItsCornerIsThePyramid) {
  const double edge = 1 / std::sqrt(3.0), bottom = -1.5 * edge;
  const std::array<double, 3> spans{edge, edge, edge};
  for (const double z : {0.1, 0.3, 0.5, edge}) {
    const double pyramid = std::pow(std::sqrt(3.0) * z, 3) / 6;
    EXPECT_NEAR(part_below<3>(spans, bottom + z), pyramid, 1e-14);
    EXPECT_NEAR(part_below<3>(spans, -bottom - z), 1 - pyramid, 1e-14);
  }
  EXPECT_NEAR(part_below<3>(spans, 0), 0.5, 1e-14);
}

// An upright box is a straight line; so is one whose other edges lie almost flat.
TEST(Domain, PartOfAnUprightBoxIsItsHeight) {
  for (const double flat : {0.0, 1e-300, 1e-14}) {
    for (const double z : {-0.6, -0.25, 0.0, 0.3, 0.7}) {
      EXPECT_NEAR((part_below<2>({1, flat}, z)), std::clamp(0.5 + z, 0.0, 1.0), 1e-13);
      EXPECT_NEAR((part_below<3>({1, flat, flat}, z)), std::clamp(0.5 + z, 0.0, 1.0), 1e-13);
    }
  }
}

// One strand of density 400 kg/m^3 (or 800 above the middle) in a panel 10 x 2 mm, its points tilted and sheared.
template <int Dim>
Panel<Dim> tilted_panel() {
  Panel<Dim> panel;
  panel.length_mm = 10;
  panel.depth_mm = Dim == 3 ? 3 : 1;
  panel.initial_thickness_mm = 4;
  panel.top_mm = 2.5;
  panel.bottom_mm = 0.5;
  for (int s = 0; s < 2; ++s) {
    Strand<Dim> strand;
    strand.material.density = (s == 0 ? 400 : 800) * kTonnePerMm3;
    strand.lattice.spacing = Vec<Dim>::Constant(0.2);
    for (int i = 0; i < 300; ++i) {
      const double u = i / 300.0, t = 0.01 * i;
      Vec<Dim> x = Vec<Dim>::Constant(10 * u);
      x[Dim - 1] = 0.55 + 1.2 * u + 0.7 * s;
      Tensor<Dim> F = Tensor<Dim>::Identity();
      F(0, 0) = std::cos(t);
      F(Dim - 1, 0) = std::sin(t);
      F(0, Dim - 1) = -0.7 * std::sin(t);
      F(Dim - 1, Dim - 1) = 0.7 * std::cos(t);
      strand.points.x.push_back(x);
      strand.points.F.push_back(F);
    }
    panel.strands.push_back(strand);
  }
  return panel;
}

template <int Dim>
double mass_over_area(const Panel<Dim>& panel) {  // kg/m^3 mm
  double mass = 0;
  for (const auto& s : panel.strands)
    mass += s.material.density / kTonnePerMm3 * s.lattice.point_volume() * static_cast<double>(s.size());
  return mass / (panel.length_mm * panel.depth_mm);
}

double integral(const Profile& p) {
  return p.bin_height_mm() * std::accumulate(p.density_kg_m3.begin(), p.density_kg_m3.end(), 0.0);
}

// Mass is never lost, whatever the bins: points that stick out of the faces (here by a third of a spacing) included.
TEST(DensityProfile, IntegralIsMassOverArea) {
  for (const int bins : {1, 7, 60, 1000}) {
    const auto section = tilted_panel<2>();
    EXPECT_NEAR(integral(density_profile(section, bins)) / mass_over_area(section), 1, 1e-12);
    const auto block = tilted_panel<3>();
    EXPECT_NEAR(integral(density_profile(block, bins)) / mass_over_area(block), 1, 1e-12);
  }
}

// Two points in four bins of 1 mm, worked out by hand: one upright of 1 mm centred on an edge, one sheared so that it
// is a triangle-ended trapezoid.
TEST(DensityProfile, PutsMassWhereThePointsAre) {
  Panel<2> panel;
  panel.length_mm = 2;
  panel.initial_thickness_mm = panel.top_mm = 4;
  Strand<2> strand;
  strand.material.density = 500 * kTonnePerMm3;
  strand.lattice.spacing = {1, 1};
  strand.points.x = {{0.5, 1.0}, {1.5, 3.0}};
  strand.points.F.assign(2, Tensor<2>::Identity());
  strand.points.F[1](1, 0) = 1;  // spans 2 mm: a parallelogram with triangular ends, 1/8 beyond half a millimetre
  panel.strands = {strand};
  const auto p = density_profile(panel, 8);  // half-millimetre bins
  const std::vector<double> share{0, .5, .5, 0, .125, .375, .375, .125};
  for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(p.density_kg_m3[k], 500 * share[k] / (2 * 0.5), 1e-11) << k;
}

TEST(DensityProfile, OfAMirroredMatIsMirrored) {
  const auto panel = tilted_panel<2>();
  auto mirrored = panel;
  for (auto& strand : mirrored.strands) {
    for (auto& x : strand.points.x) x[1] = panel.top_mm + panel.bottom_mm - x[1];
    for (auto& F : strand.points.F) F.row(1) *= -1;
  }
  const auto p = density_profile(panel, 37), q = density_profile(mirrored, 37);
  for (std::size_t k = 0; k < 37; ++k) EXPECT_NEAR(p.density_kg_m3[k], q.density_kg_m3[36 - k], 1e-9 * 400) << k;
}

TEST(DensityProfile, RefusesNoBinsAndNoThickness) {
  EXPECT_THROW(density_profile(tilted_panel<2>(), 0), InputError);
  EXPECT_THROW(density_profile(Panel<2>{}, 4), InputError);
  EXPECT_THROW(density_profiles(tilted_panel<2>(), 4, 0), InputError);
}

// Bin by bin, wherever the columns cut the points' domains.
TEST(DensityProfile, IsTheMeanOverColumns) {
  const auto panel = tilted_panel<2>();
  const auto whole = density_profile(panel, 9);
  for (const int columns : {1, 2, 7}) {
    std::vector<double> mean(9, 0);
    const auto profiles = density_profiles(panel, 9, columns);
    ASSERT_EQ(profiles.size(), static_cast<std::size_t>(columns));
    for (const auto& profile : profiles) {
      for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += profile.density_kg_m3[k] / columns;
    }
    for (std::size_t k = 0; k < mean.size(); ++k)
      EXPECT_NEAR(mean[k], whole.density_kg_m3[k], 1e-10) << columns << " columns, bin " << k;
  }
}

// A U-shaped profile whose numbers can be read off: 8 bins of 0.5 mm.
TEST(Summary, ReadsOffAProfile) {
  const Profile p{0.4, 4, {600, 900, 700, 500, 400, 600, 800, 700}};
  const auto s = summarise(p);
  EXPECT_DOUBLE_EQ(s.mean, 650);
  EXPECT_DOUBLE_EQ(s.peak_bottom, 900);
  EXPECT_DOUBLE_EQ(s.peak_bottom_depth_mm, 0.75);
  EXPECT_DOUBLE_EQ(s.peak_top, 800);
  EXPECT_DOUBLE_EQ(s.peak_top_depth_mm, 0.75);
  EXPECT_DOUBLE_EQ(s.peak, 850);
  EXPECT_NEAR(s.skin, 650, 1e-10);     // the outermost bins, 600 and 700
  EXPECT_NEAR(s.surface, 750, 1e-10);  // (600 + 900 + 800 + 700)/4
  EXPECT_NEAR(s.core, 550, 1e-10);     // (700 + 500 + 400 + 600)/4
  EXPECT_NEAR(s.surface_over_core(), 750.0 / 550, 1e-12);
}

// Three replicates 1, 2, 3: mean 2, sd 1, t(0.975, 2) = 4.30265: 2 +- 4.30265/sqrt(3).
TEST(Mean, GivesTheTIntervalByBin) {
  const auto m = mean({{0.2, 8, {1, 5}}, {0.2, 8, {2, 5}}, {0.2, 8.3, {3, 5}}});
  EXPECT_NEAR(m.thickness_mm, 8.1, 1e-12);
  EXPECT_DOUBLE_EQ(m.density_kg_m3[0].mean, 2);
  EXPECT_DOUBLE_EQ(m.density_kg_m3[0].sd, 1);
  EXPECT_NEAR(m.density_kg_m3[0].low, 2 - 4.30265 / std::sqrt(3), 1e-5);
  EXPECT_NEAR(m.density_kg_m3[0].high, 2 + 4.30265 / std::sqrt(3), 1e-5);
  EXPECT_DOUBLE_EQ(m.density_kg_m3[1].high, 5);
  EXPECT_TRUE(std::isnan(mean({{0.2, 8, {1, 5}}}).density_kg_m3[0].high));
  EXPECT_THROW(mean({}), InputError);
  EXPECT_THROW(mean({{0.2, 8, {1, 5}}, {0.2, 8, {1, 5, 6}}}), InputError);
}

// 1, 2, 3, 4 in two bins is 1.5, 3.5; in three bins of 4/3 old ones (1 + 2/3)/(4/3), (2/3*2 + 2/3*3)/(4/3), mirrored.
TEST(Rebinned, KeepsTheIntegral) {
  const Profile p{0, 1, {1, 2, 3, 4}};
  const auto two = rebinned(p, 2), three = rebinned(p, 3);
  EXPECT_NEAR(two.density_kg_m3[0], 1.5, 1e-14);
  EXPECT_NEAR(two.density_kg_m3[1], 3.5, 1e-14);
  EXPECT_NEAR(three.density_kg_m3[0], 1.25, 1e-14);
  EXPECT_NEAR(three.density_kg_m3[1], 2.5, 1e-14);
  EXPECT_NEAR(three.density_kg_m3[2], 3.75, 1e-14);
}

// Differences 3 and 4 in two bins: sqrt((9 + 16)/2).
TEST(RmsDifference, ComparesInTheCoarserBins) {
  EXPECT_NEAR(rms_difference({0, 1, {4, 6}}, {0, 2, {0, 2, 1, 3}}), std::sqrt(12.5), 1e-14);
}

}  // namespace
}  // namespace strandlab::profile
