// Curing of panels: what is glued of flat strands is known exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "strandlab/glue/glue.hpp"
#include "strandlab/mat/rectangle.hpp"

namespace strandlab::glue {
namespace {

struct Plank {
  int layer;
  double cx, cy, length, width, angle_deg;
};

constexpr double kThickness = 0.8;

mat::PlateMat mat_of(const std::vector<Plank>& planks, double length_mm, double width_mm, bool periodic) {
  mat::PlateMat mat;
  mat.length_mm = length_mm;
  mat.width_mm = width_mm;
  mat.layer_thickness_mm = kThickness;
  mat.sides = periodic ? mat::PlateSides::kPeriodic : mat::PlateSides::kCut;
  for (const auto& plank : planks) {
    while (static_cast<int>(mat.layers.size()) <= plank.layer) mat.layers.emplace_back().role = "surface";
    auto& strand = mat.layers[static_cast<std::size_t>(plank.layer)].strands.emplace_back();
    strand.cx_mm = plank.cx;
    strand.cy_mm = plank.cy;
    strand.length_mm = plank.length;
    strand.width_mm = plank.width;
    strand.angle_deg = plank.angle_deg;
  }
  return mat;
}

Panel<3> panel_of(const mat::PlateMat& mat, double spacing_mm = 2) {
  return make_panel(mat, {{"surface", wood::Material{}, 0}, {"core", wood::Material{}, 90}}, spacing_mm, 2);
}

Panel<3> open_panel(const std::vector<Plank>& planks) {
  return panel_of(mat_of(planks, 1000, 1000, false));
}

double glued_area(const std::vector<GluePoint<3>>& points) {
  double sum = 0;
  for (const auto& p : points) sum += p.area;
  return sum;
}

// By the lower strand's row, as the layers of flat mats lie.
std::vector<double> area_by_interface(const Panel<3>& panel) {
  std::vector<double> areas;
  for (const auto& p : cure(panel, {})) {
    const auto row = static_cast<std::size_t>(panel.strands[static_cast<std::size_t>(p.a.strand)].row);
    areas.resize(std::max(areas.size(), row + 1));
    areas[row] += p.area;
  }
  return areas;
}

// Two strands of 25 mm that cross at an angle a share the parallelogram 25^2/sin a.
TEST(CurePanel, GluesTheParallelogramOfACrossing) {
  for (const double angle : {90.0, 50.0, 25.0}) {
    const auto points = cure(open_panel({{0, 500, 500, 150, 25, 10}, {1, 503, 501, 150, 25, 10 + angle}}), {});
    const double expected = 625 / std::sin(angle * std::numbers::pi / 180);
    EXPECT_NEAR(glued_area(points) / expected, 1, 1e-9) << angle;
  }
}

// Points lie within the window of contact, on both faces, with a normal that looks up; away from the edges they are at
// corners of the lower face.
TEST(CurePanel, PutsPointsOnBothFaces) {
  const auto panel = open_panel({{0, 500, 500, 30, 10, 0}, {1, 500, 500, 30, 10, 90}});
  int at_corners = 0;
  for (const auto& p : cure(panel, {})) {
    EXPECT_EQ(p.a.strand, 0);
    EXPECT_EQ(p.b.strand, 1);
    EXPECT_NEAR((p.a.position - p.b.position).norm(), 0, 1e-9);
    EXPECT_NEAR(p.a.position[2], kThickness, 1e-12);
    EXPECT_NEAR((p.normal - Vec<3>::UnitZ()).norm(), 0, 1e-12);
    EXPECT_NEAR(p.a.place[0] * 2 + 485, p.a.position[0], 1e-9);  // the lattice's points are 2 mm apart
    EXPECT_NEAR(p.b.place[0] * 2 + 485, p.b.position[1], 1e-9);  // a quarter turn: along is y
    if (std::abs(p.a.place[0] - std::round(p.a.place[0])) + std::abs(p.a.place[1] - std::round(p.a.place[1])) < 1e-9)
      ++at_corners;
  }
  EXPECT_EQ(at_corners, 4 * 4);  // of the 10 x 10 mm between corners of 2 mm, from x = 497 on: those with a whole share
}

// Area of the common part of two rectangles: corners of one cut by the sides of the other.
double common_area(const mat::Rectangle& a, const mat::Rectangle& b) {
  const auto corner = [](const mat::Rectangle& r, double s, double t) {
    return Vec<2>(r.cx + s * r.half_length * r.cos - t * r.half_width * r.sin,
                  r.cy + s * r.half_length * r.sin + t * r.half_width * r.cos);
  };
  std::vector<Vec<2>> polygon{corner(a, -1, -1), corner(a, 1, -1), corner(a, 1, 1), corner(a, -1, 1)};
  const std::vector<Vec<2>> sides{corner(b, -1, -1), corner(b, 1, -1), corner(b, 1, 1), corner(b, -1, 1)};
  const auto cross = [](const Vec<2>& p, const Vec<2>& q) { return p[0] * q[1] - p[1] * q[0]; };
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec<2> from = sides[k], along = sides[(k + 1) % 4] - from;
    std::vector<Vec<2>> left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec<2> p = polygon[i], q = polygon[(i + 1) % polygon.size()];
      const double before = cross(along, p - from), after = cross(along, q - from);
      if (before >= 0) left.push_back(p);
      if (before * after < 0) left.emplace_back(p + before / (before - after) * (q - p));
    }
    polygon = left;
  }
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) area += 0.5 * cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return area;
}

// Any two flat strands are glued where their rectangles overlap, with whatever corners end inside.
TEST(CurePanel, GluesTheCommonPartOfAnyTwoRectangles) {
  for (int k = 0; k < 40; ++k) {
    const double angle = 37.3 * k, dx = 1.7 * (k % 9 - 4), dy = 2.3 * (k % 7 - 3);
    const Plank lower{0, 500, 500, 23.7, 9.1, 11.0 * k}, upper{1, 500 + dx, 500 + dy, 31.3, 5.9, angle};
    const double expected = common_area(mat::rectangle(lower.cx, lower.cy, lower.length, lower.width, lower.angle_deg),
                                        mat::rectangle(upper.cx, upper.cy, upper.length, upper.width, upper.angle_deg));
    EXPECT_NEAR(glued_area(cure(open_panel({lower, upper}), {})), expected, 1e-9 * 9.1 * 23.7) << k;
  }
}

// The reference mats' areas between layers are known exactly, to the six decimals of their numbers. rot_a has strands
// at any angle, of which some overlap within their layer by a hair: what they would share is glued to one of them only.
TEST(CurePanel, GluesTheAreasOfReferenceMats) {
  const std::string folder = STRANDLAB_TEST_DATA "/mats3d/";
  const auto reference = nlohmann::json::parse(std::ifstream(folder + "fe_moduli3d.json"));
  for (const std::string name : {"per_a", "per_a_45", "per_a_26", "rot_a", "cut_a"}) {
    const auto mat = mat::read_plate(folder + name + ".json", {{"surface", 0}, {"core", 90}});
    const auto areas = area_by_interface(panel_of(mat));
    const auto expected = reference[name]["glued_area_mm2"].get<std::vector<double>>();
    ASSERT_EQ(areas.size(), expected.size()) << name;
    for (std::size_t k = 0; k < areas.size(); ++k)
      EXPECT_NEAR(areas[k] / expected[k], 1, name == "rot_a" ? 2e-7 : 2e-9) << name << " " << k;
  }
}

const std::vector<Plank> kMat{{0, 4, 7, 18, 6, 20},   {0, 13, 15, 16, 5, -65}, {1, 9, 2, 17, 7, 100},
                              {1, 18, 11, 15, 6, 75}, {2, 1, 19, 18, 8, -8},   {2, 12, 9, 17, 5, 3}};

// Strands laid down elsewhere on the torus, the torus transposed (x for y), and the order of strands turned around glue
// the same areas.
TEST(CurePanel, DoesNotCareWhereTheTorusBegins) {
  const auto areas = [](const std::vector<Plank>& planks, double wx, double wy) {
    return area_by_interface(panel_of(mat_of(planks, wx, wy, true)));
  };
  const auto expected = areas(kMat, 20, 24);
  ASSERT_EQ(expected.size(), 2U);
  EXPECT_GT(expected[0], 50);
  auto shifted = kMat, transposed = kMat;
  for (auto& p : shifted)
    p = {p.layer, std::fmod(p.cx + 13.7, 20), std::fmod(p.cy + 21.1, 24), p.length, p.width, p.angle_deg};
  for (auto& p : transposed) p = {p.layer, p.cy, p.cx, p.length, p.width, 90 - p.angle_deg};
  const std::vector<Plank> backwards(kMat.rbegin(), kMat.rend());
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(areas(shifted, 20, 24)[k] / expected[k], 1, 1e-9);
    EXPECT_NEAR(areas(transposed, 24, 20)[k] / expected[k], 1, 1e-9);
    EXPECT_NEAR(areas(backwards, 20, 24)[k] / expected[k], 1, 1e-9);
  }
}

// Which strand lies above is a matter of heights: rows may say anything.
TEST(CurePanel, DoesNotReadTheOrderOfHeightsFromRows) {
  auto panel = panel_of(mat_of(kMat, 20, 24, true));
  const double expected = glued_area(cure(panel, {}));
  for (auto& strand : panel.strands) strand.row = -strand.row;
  EXPECT_EQ(glued_area(cure(panel, {})), expected);
}

// A strand that lies across the seam of the torus meets another's images.
TEST(CurePanel, GluesImages) {
  const auto panel = panel_of(mat_of({{0, 1, 1, 12, 4, 0}, {1, 19, 19, 4, 12, 0}}, 20, 20, true));
  const auto points = cure(panel, {});
  EXPECT_NEAR(glued_area(points), 4 * 4,
              1e-9);  // x from -3 to 1, y from -1 to 3, a period away from the upper strand's own
  for (const auto& p : points) EXPECT_EQ(p.b.image, (std::array<int, 2>{-1, -1}));
}

// Nothing is glued through a strand, however wide the gap that may be glued.
TEST(CurePanel, GluesToTheNearestOnly) {
  const std::vector<Plank> planks{{0, 500, 500, 30, 10, 0}, {1, 495, 500, 8, 10, 0}, {2, 500, 500, 30, 10, 30}};
  CuringOptions wide;
  wide.max_gap_mm = 2 * kThickness;
  double between_outer = 0;
  for (const auto& p : cure(open_panel(planks), wide)) {
    if (p.a.strand == 0 && p.b.strand == 2) between_outer += p.area;
  }
  const auto part = [&](double x0, double x1) {
    return common_area(mat::rectangle(0.5 * (x0 + x1), 500, x1 - x0, 10, 0), mat::rectangle(500, 500, 30, 10, 30));
  };
  EXPECT_NEAR(between_outer, part(485, 515) - part(491, 499), 1e-8);
}

// A face that stands off by more than the gap is not glued; one on a slope only as far as the gap is small enough.
TEST(CurePanel, EndsWhereTheGapOpens) {
  auto panel = open_panel({{0, 500, 500, 30, 10, 0}, {1, 500, 500, 30, 10, 0}});
  auto& upper = panel.strands[1];
  const double slope = 0.02;  // from a gap of 0 at x = 485: .1 mm is reached 5 mm further
  for (std::size_t p = 0; p < upper.size(); ++p) {
    upper.points.x[p][2] += slope * (upper.points.x[p][0] - 485);
    upper.points.F[p](2, 0) = slope;
  }
  EXPECT_NEAR(glued_area(cure(panel, {})), 5 * 10, 0.05 * 50);
}

}  // namespace
}  // namespace strandlab::glue
