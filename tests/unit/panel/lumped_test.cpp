// A coarse panel keeps what a picture shows of the fine one.
#include "strandlab/panel/lumped.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

namespace strandlab {
namespace {

// One strand of 7 mm by 1.2 mm, undeformed, with six points through it; along it they are about `spacing_mm` apart.
Panel<2> one_strand(double spacing_mm = 1) {
  mat::Mat mat;
  mat.length_mm = 7;
  mat.layer_thickness_mm = 1.2;
  mat.layers.resize(1);
  mat.layers[0].role = "surface";
  mat.layers[0].strands.resize(1);
  mat.layers[0].strands[0].x1_mm = 7;
  return make_panel(mat, {{"surface", wood::library().front(), 0}}, spacing_mm, 6);
}

// Every point moved by x -> map(x), its deformation gradient by central differences.
template <class Map>
void deform(Panel<2>& panel, const Map& map) {
  constexpr double kStep = 1e-6;
  for (auto& s : panel.strands) {
    for (std::size_t p = 0; p < s.size(); ++p) {
      for (int d = 0; d < 2; ++d) {
        Vec<2> step = Vec<2>::Zero();
        step[d] = kStep;
        s.points.F[p].col(d) = (map(s.points.x[p] + step) - map(s.points.x[p] - step)) / (2 * kStep);
      }
      s.points.x[p] = map(s.points.x[p]);
    }
  }
}

double area(const Strand<2>& strand) {
  double sum = 0;
  for (const auto& F : strand.points.F) sum += F.determinant() * strand.lattice.point_volume();
  return sum;
}

// A homogeneous deformation has one gradient everywhere: the coarse strand has it too, and its corners are corners of
// the fine one to round-off, also where 7 points do not divide into 3.
TEST(Lumped, HomogeneousDeformationIsExact) {
  auto panel = one_strand();
  const Tensor<2> F{{1.1, 0.2}, {-0.05, 0.6}};
  deform(panel, [&](const Vec<2>& x) -> Vec<2> { return F * x; });
  const auto coarse = lumped(panel, 7.0 / 3, 2);
  const auto& s = coarse.strands.at(0);
  ASSERT_EQ(s.lattice.counts, (std::array<int, 2>{3, 2}));
  EXPECT_NEAR(s.lattice.extent(0), 7, 1e-12);
  for (const auto& g : s.points.F) EXPECT_LT((g - F).norm(), 1e-8);
  const auto lattice = corners(s);
  for (int j = 0; j <= 2; ++j) {
    for (int i = 0; i <= 3; ++i) {
      const Vec<2> expected = F * Vec<2>(i * 7.0 / 3, j * 0.6);
      EXPECT_LT((lattice[static_cast<std::size_t>(4 * j + i)] - expected).norm(), 1e-7);
    }
  }
}

// Wave of 0.2 mm over 7 mm: sampled with 3.5 points a millimetre and lumped by two it keeps its area to 0.1 % (chords
// of length h cut (k h)^2/24 of a wave of wave number k: (0.9 * 0.57)^2/24 = 1 %, of which areas see the square).
TEST(Lumped, UndulatingStrandKeepsItsArea) {
  auto panel = one_strand(0.2857);
  deform(panel, [](const Vec<2>& x) {
    return Vec<2>(x[0], x[1] * (0.8 + 0.1 * std::sin(0.9 * x[0])) + 0.2 * std::sin(0.9 * x[0]));
  });
  const auto coarse = lumped(panel, 0.57, 3);
  EXPECT_NEAR(area(coarse.strands[0]) / area(panel.strands[0]), 1, 1e-3);
}

// Stress and plastic strain are means over the wood of a coarse point: their totals stay.
TEST(Lumped, MeansKeepTotals) {
  auto panel = one_strand();
  auto& fine = panel.strands[0];
  double plastic = 0, stress = 0;
  for (std::size_t p = 0; p < fine.size(); ++p) {
    fine.points.plastic[p] = 0.1 * static_cast<double>(p % 7) + static_cast<double>(p / 7);
    fine.points.stress[p][2] = -fine.points.plastic[p] * fine.points.plastic[p];
    plastic += fine.points.plastic[p] * fine.lattice.point_volume();
    stress += fine.points.stress[p][2] * fine.lattice.point_volume();
  }
  const auto coarse = lumped(panel, 7.0 / 3, 4);
  const auto& s = coarse.strands[0];
  double coarse_plastic = 0, coarse_stress = 0;
  for (std::size_t p = 0; p < s.size(); ++p) {
    coarse_plastic += s.points.plastic[p] * s.lattice.point_volume();
    coarse_stress += s.points.stress[p][2] * s.lattice.point_volume();
  }
  EXPECT_NEAR(coarse_plastic, plastic, 1e-12 * plastic);
  EXPECT_NEAR(coarse_stress, stress, 1e-12 * std::abs(stress));
}

TEST(Lumped, NeverFinerThanThePanelAndNeverNothing) {
  const auto panel = one_strand();
  EXPECT_EQ(lumped(panel, 1e-3, 50).strands[0].lattice.counts, panel.strands[0].lattice.counts);
  EXPECT_EQ(lumped(panel, 1e3, 1).strands[0].lattice.counts, (std::array<int, 2>{1, 1}));
  EXPECT_THROW(lumped(panel, 0, 3), std::invalid_argument);
  EXPECT_THROW(lumped(panel, 1, 0), std::invalid_argument);
}

}  // namespace
}  // namespace strandlab
