// A half panel and its mirror image: what points show to the outside is mirrored.
#include "strandlab/panel/mirrored.hpp"

#include <gtest/gtest.h>

#include "strandlab/panel/point_fields.hpp"
#include "support/strands.hpp"

namespace strandlab {
namespace {

Panel<3> half_panel() {
  Panel<3> panel;
  panel.length_mm = panel.depth_mm = 10;
  panel.periodic = true;
  panel.bottom_mm = 0.5;
  panel.top_mm = 2;
  panel.initial_thickness_mm = 1.6;
  const auto wood = wood::in_strand_axes(wood::Material{}, 0);
  for (int row = 0; row < 2; ++row) {
    const Lattice<3> lattice{{4, 3, 2}, {1, 1, 0.4}};
    panel.strands.push_back(formed_strand<3>(lattice, turned(lattice, {4, 5, 0.9 + 0.8 * row}, 20.0 + 30 * row), wood));
    auto& strand = panel.strands.back();
    strand.row = row;
    for (std::size_t p = 0; p < strand.size(); ++p) {
      const auto s = static_cast<double>(p);
      Tensor<3> more;
      more << 1.1, 0.02, 0.03 * s, -0.05, 0.9, 0.01, 0.04, -0.02 * s, 0.7;
      strand.points.F[p] = more * strand.points.F[p];
      strand.points.stress[p] << 1, 2, 3, 4 + s, 5, 6;
      strand.points.plastic[p] = s;
      strand.points.v[p] = {1, s, -3};
    }
  }
  return panel;
}

TEST(WithMirrorImage, PutsTheImageBelow) {
  const auto half = half_panel();
  const auto whole = with_mirror_image(half);
  ASSERT_EQ(whole.strands.size(), 4U);
  EXPECT_DOUBLE_EQ(whole.thickness_mm(), 3);
  EXPECT_DOUBLE_EQ(whole.compaction(), half.compaction());
  for (int row = 0; row < 4; ++row) EXPECT_EQ(whole.strands[static_cast<std::size_t>(row)].row, row);
  const Tensor<3> mirror = Vec<3>(1, 1, -1).asDiagonal();
  for (std::size_t row = 0; row < 2; ++row) {
    const auto &s = half.strands[row], &image = whole.strands[1 - row];
    const auto at = corners(image);
    EXPECT_GT(at.back()[2], at.front()[2]);  // the lattice counts upwards
    for (std::size_t p = 0; p < s.size(); ++p) {
      auto place = s.lattice.place_of_point(p);
      place[2] = 1 - place[2];
      const auto q = s.lattice.point(place);
      EXPECT_DOUBLE_EQ(image.points.x[q][2], 1 - s.points.x[p][2]);
      EXPECT_EQ(image.points.x[q][0], s.points.x[p][0]);
      EXPECT_EQ(image.points.v[q][2], 3);
      EXPECT_EQ(image.points.plastic[q], s.points.plastic[p]);
      EXPECT_DOUBLE_EQ(density_kg_m3(image, q), density_kg_m3(s, p));
      EXPECT_DOUBLE_EQ(grain_angle_deg<3>(image.points.F[q]), -grain_angle_deg<3>(s.points.F[p]));
      const Tensor<3> sigma = cauchy_stress<3>(s.points.F[p], s.points.stress[p]);
      EXPECT_TRUE(cauchy_stress<3>(image.points.F[q], image.points.stress[q]).isApprox(mirror * sigma * mirror, 1e-12));
    }
  }
}

}  // namespace
}  // namespace strandlab
