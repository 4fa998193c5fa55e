// Index sums of a lattice against what can be counted on the fingers: 3 x 2 points in a section, 3 x 4 x 2 in space.
#include "strandlab/lattice/lattice.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

namespace strandlab {
namespace {

using Numbers = std::vector<std::size_t>;

const Lattice<2> kSection{{3, 2}, {0.5, 0.25}};
const Lattice<3> kBlock{{3, 4, 2}, {0.5, 0.3, 0.25}};

TEST(Lattice, SizesAreThoseOfTheBox) {
  EXPECT_EQ(kSection.size(), 6U);
  EXPECT_EQ(kSection.corner_count(), 4U * 3U);
  EXPECT_EQ(kBlock.size(), 24U);
  EXPECT_EQ(kBlock.corner_count(), 4U * 5U * 3U);
  EXPECT_DOUBLE_EQ(kBlock.extent(1), 1.2);
  EXPECT_DOUBLE_EQ(kBlock.thickness(), 0.5);
  EXPECT_DOUBLE_EQ(kBlock.point_volume(), 0.0375);
  EXPECT_EQ(Lattice<3>{}.size(), 0U);
}

// Along the strand runs fastest, rows stack through the thickness.
TEST(Lattice, NumbersRunAlongTheStrandFirst) {
  EXPECT_EQ(kSection.point({2, 0}), 2U);
  EXPECT_EQ(kSection.point({0, 1}), 3U);
  EXPECT_EQ(kSection.corner({0, 1}), 4U);
  EXPECT_EQ(kBlock.point({1, 2, 1}), 1U + 3U * (2U + 4U * 1U));
  EXPECT_EQ(kBlock.corner({1, 2, 1}), 1U + 4U * (2U + 5U * 1U));
}

template <int Dim>
void expect_round_trip(const Lattice<Dim>& lattice) {
  for (std::size_t p = 0; p < lattice.size(); ++p) EXPECT_EQ(lattice.point(lattice.place_of_point(p)), p);
  for (std::size_t c = 0; c < lattice.corner_count(); ++c) EXPECT_EQ(lattice.corner(lattice.place_of_corner(c)), c);
}

TEST(Lattice, PlacesLeadBackToTheirNumbers) {
  expect_round_trip(kSection);
  expect_round_trip(kBlock);
}

// Corner (i, j, k) of the undeformed box is at (i, j, k) times the spacing.
template <int Dim>
Vec<Dim> corner_position(const Lattice<Dim>& lattice, std::size_t corner) {
  const auto place = lattice.place_of_corner(corner);
  Vec<Dim> x;
  for (int a = 0; a < Dim; ++a) x[a] = place[a] * lattice.spacing[a];
  return x;
}

TEST(Lattice, CellGoesAroundItsPointAnticlockwise) {
  EXPECT_EQ(kSection.cell(4), (std::array<std::size_t, 4>{5, 6, 10, 9}));
  for (std::size_t p = 0; p < kBlock.size(); ++p) {
    const auto cell = kBlock.cell(p);
    const auto at = [&](int k) { return corner_position(kBlock, cell[k]); };
    Tensor<3> edges;
    edges << at(1) - at(0), at(3) - at(0), at(4) - at(0);
    EXPECT_NEAR(edges.determinant(), kBlock.point_volume(), 1e-15);
    EXPECT_LT((at(6) - at(0) - edges.rowwise().sum()).norm(), 1e-15);
    EXPECT_LT((at(2) - at(3) - at(1) + at(0)).norm() + (at(5) - at(4) - at(1) + at(0)).norm(), 1e-15);
  }
}

TEST(Lattice, FacesHoldTheirPointsAndCorners) {
  EXPECT_EQ(kSection.face_points(kBottom<2>), (Numbers{0, 1, 2}));
  EXPECT_EQ(kSection.face_points(kTop<2>), (Numbers{3, 4, 5}));
  EXPECT_EQ(kSection.face_points(kRightEnd), (Numbers{2, 5}));
  EXPECT_EQ(kSection.face_corners(kTop<2>), (Numbers{8, 9, 10, 11}));
  EXPECT_EQ(kSection.face_corners(kLeftEnd), (Numbers{0, 4, 8}));
  EXPECT_EQ(kBlock.face_points(kNearEdge), (Numbers{0, 1, 2, 12, 13, 14}));
  EXPECT_EQ(kBlock.face_points(kFarEdge), (Numbers{9, 10, 11, 21, 22, 23}));
}

// The faces of a box together hold every corner that is not inside: 60 but 2 x 3 x 1 in the block's middle.
TEST(Lattice, FacesCloseTheBox) {
  std::set<std::size_t> corners;
  for (const auto& face : lattice_faces<3>()) {
    for (const auto c : kBlock.face_corners(face)) corners.insert(c);
  }
  EXPECT_EQ(corners.size(), 60U - 6U);
}

TEST(Lattice, OutlineGoesAroundTheSectionAnticlockwise) {
  EXPECT_EQ(outline(kSection), (Numbers{0, 1, 2, 3, 7, 11, 10, 9, 8, 4}));
}

// What every point says alike of a corner is the mean too: a linear field from points and offsets comes out exactly.
TEST(CornerMeans, OfALinearFieldAreExact) {
  const Vec<3> slope(2, -3, 5);
  const auto x = positions<3>(kBlock, {});
  const auto values =
      corner_means(kBlock, [&](std::size_t p, const Vec<3>& offset) { return slope.dot(x[p] + offset); });
  ASSERT_EQ(values.size(), kBlock.corner_count());
  for (std::size_t c = 0; c < values.size(); ++c) {
    EXPECT_NEAR(values[c], slope.dot(corner_position(kBlock, c)), 1e-14) << "corner " << c;
  }
}

// Trilinear: a x y z + b x + c is reproduced between the corners of every cell, and goes on beyond the ends.
TEST(BetweenCorners, IsExactForWhatIsLinearAlongEachAxis) {
  const auto field = [](const Vec<3>& s) { return 0.7 * s[0] * s[1] * s[2] - s[0] + 3; };
  std::vector<double> corners;
  for (std::size_t c = 0; c < kBlock.corner_count(); ++c) {
    const auto place = kBlock.place_of_corner(c);
    corners.push_back(field(Vec<3>(place[0], place[1], place[2])));
  }
  for (const Vec<3>& s :
       {Vec<3>(0, 0, 0), Vec<3>(3, 4, 2), Vec<3>(1.3, 2.9, 0.4), Vec<3>(2, 1, 1), Vec<3>(2.5, 0.1, 2)}) {
    EXPECT_NEAR(kBlock.between_corners(corners, s), field(s), 1e-13) << s.transpose();
  }
  const std::vector<double> straight{0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
  EXPECT_NEAR(kSection.between_corners(straight, Vec<2>(3.5, 1)), 3.5, 1e-14);
}

// Seven parts of 11 points, none of which ends at a point: every point is covered once.
TEST(Cover, PartsOfAnAxisAddUpToEveryPoint) {
  constexpr int kPoints = 11, kParts = 7;
  std::vector<double> covered(kPoints, 0.0);
  for (int k = 0; k < kParts; ++k) {
    const Cover part(k * 11.0 / kParts, (k + 1) * 11.0 / kParts, kPoints);
    double sum = 0;
    for (int p = part.first; p < part.end; ++p) {
      covered[p] += part.weight(p);
      sum += part.weight(p);
    }
    EXPECT_NEAR(sum, 11.0 / kParts, 1e-14);
  }
  for (const double c : covered) EXPECT_NEAR(c, 1, 1e-14);
}

// Round-off may put the end of the last part beyond the last point: there is nothing to visit.
TEST(Cover, NeverLeavesTheLattice) {
  const Cover last(2.5, std::nextafter(3.0, 4.0), 3);
  EXPECT_EQ(last.first, 2);
  EXPECT_EQ(last.end, 3);
}

// A box of 1.5 x 2 x 1 cells from (0.5, 1, 0.25): its volume in cells, and no point outside it.
TEST(ForEachCovered, WeighsCellsByTheirPartInTheBox) {
  double volume = 0;
  Vec<3> centre = Vec<3>::Zero();
  for_each_covered(kBlock, Vec<3>(0.5, 1, 0.25), Vec<3>(2, 3, 1.25), [&](std::size_t p, double weight) {
    const auto place = kBlock.place_of_point(p);
    EXPECT_TRUE(place[0] < 2 && place[1] >= 1 && place[1] < 3) << p;
    volume += weight;
    centre[1] += weight * (place[1] + 0.5);
  });
  EXPECT_NEAR(volume, 1.5 * 2 * 1, 1e-14);
  EXPECT_NEAR(centre[1] / volume, 2, 1e-14);
}

TEST(Positions, OfASectionStandUpright) {
  const auto x = positions<2>(kSection, {{10, 1}});
  EXPECT_LT((x[0] - Vec<2>(10.25, 1.125)).norm(), 1e-15);
  EXPECT_LT((x[5] - Vec<2>(11.25, 1.375)).norm(), 1e-15);
}

// A strand of 1.5 x 1.2 x 0.5 mm turned by 25 degrees about its middle: the middle stays, lengths stay, the first axis
// points 25 degrees off x, the thickness stays upright.
TEST(Positions, OfATurnedStrandKeepItsShape) {
  const Vec<3> centre(0.2, 7, 3);
  const auto placement = turned(kBlock, centre, 25);
  const auto x = positions(kBlock, placement);
  const Vec<3> sum = std::accumulate(x.begin(), x.end(), Vec<3>(Vec<3>::Zero()));
  EXPECT_LT((sum / 24 - centre).norm(), 1e-14);
  const Vec<3> along = x[kBlock.point({2, 0, 0})] - x[0], across = x[kBlock.point({0, 3, 0})] - x[0];
  EXPECT_NEAR(along.norm(), 2 * 0.5, 1e-14);
  EXPECT_NEAR(across.norm(), 3 * 0.3, 1e-14);
  EXPECT_NEAR(std::atan2(along[1], along[0]) * 180 / std::numbers::pi, 25, 1e-12);
  EXPECT_NEAR(along.dot(across), 0, 1e-15);
  EXPECT_GT(along.cross(across)[2], 0);
  EXPECT_LT((x[kBlock.point({0, 0, 1})] - x[0] - Vec<3>(0, 0, 0.25)).norm(), 1e-14);
  EXPECT_LT(x[0][0], 0);  // beyond the edge of a window from 0: positions are not wrapped
}

// Quarter turns to the last bit: a mat of 0 and 90 degrees has no skew of round-off.
TEST(Positions, QuarterTurnsAreExact) {
  Tensor<3> quarter;
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  Tensor<3> turn = Tensor<3>::Identity();
  for (const double angle : {0.0, 90.0, 180.0, 270.0, 360.0}) {
    EXPECT_EQ(turned(kBlock, Vec<3>::Zero(), angle).axes, turn) << angle;
    turn = quarter * turn;
  }
  EXPECT_EQ(turned(kBlock, Vec<3>::Zero(), -90).axes, quarter.transpose());
}

}  // namespace
}  // namespace strandlab
