// The table of the points' fields, and what is read off points on a lattice.
#include "strandlab/lattice/points.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

namespace strandlab {
namespace {

template <int Dim>
void expect_table() {
  std::set<std::string> names;
  for_each_field<Dim>([&](const auto& field) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name << " twice";
    EXPECT_NE(std::string(field.unit), "") << field.name;
    EXPECT_NE(std::string(field.description), "") << field.name;
    EXPECT_EQ(field.shape().size(), static_cast<std::size_t>(field.rank())) << field.name;
    EXPECT_TRUE(field.kScalar || !field.shown) << field.name << ": only scalars are shown as they are";
  });
  EXPECT_EQ(names.count("position_mm"), 1U);
}

TEST(PointFields, EveryFieldHasOneRowWithNameUnitAndShape) {
  expect_table<2>();
  expect_table<3>();
}

// A vector, a tensor, six of Voigt's order and a number, as files keep them.
TEST(PointFields, ShapesAreThoseOfTheValues) {
  std::map<std::string, std::vector<std::size_t>> shapes;
  for_each_field<3>([&](const auto& field) { shapes[field.name] = field.shape(); });
  EXPECT_EQ(shapes.at("position_mm"), (std::vector<std::size_t>{3}));
  EXPECT_EQ(shapes.at("deformation_gradient"), (std::vector<std::size_t>{3, 3}));
  EXPECT_EQ(shapes.at("kirchhoff_stress_MPa"), (std::vector<std::size_t>{6}));
  EXPECT_EQ(shapes.at("plastic_strain"), (std::vector<std::size_t>{}));
}

// As formed: nothing but the placement's turn in F, everything else zero and as long as the lattice, optional fields
// not there.
TEST(FormedPoints, AreAtRest) {
  const Lattice<3> lattice{{4, 3, 2}, {0.5, 0.5, 0.2}};
  const auto placement = turned(lattice, Vec<3>(1, 2, 3), 30);
  const auto points = formed_points(lattice, placement);
  EXPECT_EQ(points.size(), lattice.size());
  for_each_field<3>([&](const auto& field) {
    const auto& values = points.*field.values;
    if (field.optional) {
      EXPECT_TRUE(values.empty()) << field.name;
      return;
    }
    ASSERT_EQ(values.size(), lattice.size()) << field.name;
    if (field.lumped == Lumped::kFromCorners) return;  // x and F
    for (const auto& value : values) EXPECT_EQ(value, zero_of<std::decay_t<decltype(value)>>()) << field.name;
  });
  for (const auto& F : points.F) EXPECT_EQ(F, placement.axes);
}

// Under x -> A x + b all domains that meet at a corner put it at the same place: the corners of a turned strand are
// its outer dimensions, moved and deformed.
TEST(Corners, OfATurnedAndDeformedStrandAreExact) {
  const Lattice<3> lattice{{4, 3, 2}, {0.5, 0.5, 0.2}};
  const auto placement = turned(lattice, Vec<3>(1, 2, 3), 30);
  auto points = formed_points(lattice, placement);
  const Tensor<3> A{{1.03, 0.2, 0}, {-0.1, 0.9, 0.05}, {0.1, 0, 0.6}};
  const Vec<3> b(3, -1, 2);
  for (std::size_t p = 0; p < points.size(); ++p) {
    points.x[p] = A * points.x[p] + b;
    points.F[p] = A * points.F[p];
  }
  const auto x = corners(lattice, points);
  ASSERT_EQ(x.size(), lattice.corner_count());
  for (std::size_t c = 0; c < x.size(); ++c) {
    const auto place = lattice.place_of_corner(c);
    const Vec<3> local(place[0] * 0.5, place[1] * 0.5, place[2] * 0.2);
    EXPECT_LT((x[c] - (A * (placement.corner + placement.axes * local) + b)).norm(), 1e-14) << "corner " << c;
  }
}

// Any other field: an end corner has one neighbour, one between two of them their mean.
TEST(Corners, ValuesOfAFieldAreMeansOfTheNeighbours) {
  const Lattice<2> lattice{{2, 1}, {1, 1}};
  EXPECT_EQ(corner_values(lattice, std::vector<double>{20, 30}), (std::vector<double>{20, 25, 30, 20, 25, 30}));
}

}  // namespace
}  // namespace strandlab
