#include "strandlab/panel/panel.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/mat/form.hpp"

namespace strandlab {
namespace {

std::vector<StrandKind> kinds() {
  return {{"surface", wood::library()[0], 0}, {"core", wood::library()[0], 90}, {"skin", wood::library()[1], 0}};
}

mat::Mat random_mat(std::uint64_t seed) {
  mat::Layup layup;
  layup.length_mm = 60;
  layup.rows = {{"surface", {150, 20, 15, 4.95}}, {"core", {25, 3, 10, 1}}, {"core", {25, 3, 10, 1}}};
  return mat::form(layup, seed);
}

mat::Mat one_strand(double x0, double x1) {
  mat::Mat mat;
  mat.length_mm = 100;
  mat.layer_thickness_mm = 0.8;
  mat.layers.resize(2);
  for (auto& layer : mat.layers) {
    layer.role = "surface";
    layer.strands.resize(1);
    layer.strands[0].x0_mm = x0;
    layer.strands[0].x1_mm = x1;
  }
  return mat;
}

// Strand ends are exact: spacing times points is the strand's length, half a spacing beyond the outermost points are
// its ends, and neighbouring rows share their faces. The spacing stays within half a particle of what was asked for.
TEST(MakePanel, ParticlesFillEveryStrandExactly) {
  const double asked = 0.8 / 6;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto mat = random_mat(seed);
    const auto panel = make_panel(mat, kinds(), asked, 6);
    std::size_t next = 0;
    for (std::size_t row = 0; row < mat.layers.size(); ++row) {
      for (const auto& piece : mat.layers[row].strands) {
        const auto& s = panel.strands.at(next++);
        EXPECT_EQ(s.row, static_cast<int>(row));
        EXPECT_EQ(s.kind, mat.layers[row].role);
        EXPECT_EQ(s.lattice.counts[1], 6);
        ASSERT_EQ(s.size(), s.lattice.size());
        const double length = piece.x1_mm - piece.x0_mm;
        EXPECT_NEAR(s.lattice.extent(0), length, 1e-13 * length);
        EXPECT_LT(std::abs(s.lattice.counts[0] - length / asked), 0.5 + 1e-9);
        EXPECT_NEAR(s.points.x.front()[0] - s.lattice.spacing[0] / 2, piece.x0_mm, 1e-12);
        EXPECT_NEAR(s.points.x.back()[0] + s.lattice.spacing[0] / 2, piece.x1_mm, 1e-12);
        EXPECT_NEAR(s.points.x.front()[1] - s.lattice.spacing[1] / 2, 0.8 * s.row, 1e-13);
        EXPECT_NEAR(s.points.x.back()[1] + s.lattice.spacing[1] / 2, 0.8 * (s.row + 1), 1e-13);
      }
    }
    EXPECT_EQ(next, panel.strands.size());
  }
}

// Order of the lattice: along fastest, rows of points from the bottom up.
TEST(MakePanel, PointsRunAlongFirst) {
  const auto s = make_panel(one_strand(10, 14), kinds(), 1.0, 2).strands.at(1);
  ASSERT_EQ(s.lattice.counts[0], 4);
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 4; ++i) {
      const auto& x = s.points.x[static_cast<std::size_t>(i) + 4 * static_cast<std::size_t>(j)];
      EXPECT_NEAR(x[0], 10.5 + i, 1e-13);
      EXPECT_NEAR(x[1], 1.0 + 0.4 * j, 1e-13);
    }
  }
}

TEST(MakePanel, AStrandShorterThanTheSpacingIsOnePointLong) {
  const auto s = make_panel(one_strand(99.99, 100), kinds(), 0.4, 3).strands.at(0);
  EXPECT_EQ(s.lattice.counts[0], 1);
  EXPECT_NEAR(s.lattice.spacing[0], 0.01, 1e-12);
  EXPECT_NEAR(s.points.x[0][0], 99.995, 1e-12);
}

TEST(MakePanel, StartsAtRestUnstrainedAndUncompacted) {
  const auto panel = make_panel(random_mat(1), kinds(), 0.4, 3);
  EXPECT_EQ(panel.length_mm, 60);
  EXPECT_DOUBLE_EQ(panel.thickness_mm(), 2.4);
  EXPECT_EQ(panel.compaction(), 0);
  for (const auto& s : panel.strands) {
    for (std::size_t p = 0; p < s.size(); ++p) {
      EXPECT_EQ(s.points.F[p], Tensor<2>::Identity());
      EXPECT_TRUE(s.points.v[p].isZero(0) && s.points.stress[p].isZero(0));
      EXPECT_EQ(s.points.plastic[p], 0);
    }
  }
}

// A strand takes angle and material from its kind unless the mat file gives its own.
TEST(MakePanel, StrandsMayDifferFromTheirKind) {
  auto mat = one_strand(0, 100);
  mat.layers[1].strands[0].angle_deg = 45;
  mat.layers[1].strands[0].material = "vtc";
  const auto panel = make_panel(mat, kinds(), 0.4, 3);
  EXPECT_EQ(panel.strands[0].angle_deg, 0);
  EXPECT_EQ(panel.strands[0].material.stiffness, wood::in_strand_axes(wood::library()[0], 0).stiffness);
  EXPECT_EQ(panel.strands[1].angle_deg, 45);
  EXPECT_EQ(panel.strands[1].material.stiffness, wood::in_strand_axes(wood::library()[1], 45).stiffness);
  EXPECT_DOUBLE_EQ(panel.strands[1].material.density, 910e-12);
}

// Rows of different thickness: points fill each exactly, their height is near that of the thinnest row's, rows share
// their faces, and the platens lie on the outer ones.
TEST(MakePanel, RowsTakeTheirThickness) {
  auto mat = random_mat(3);
  mat.layers[0].thickness_mm = 1.1;
  mat.layers[2].thickness_mm = 2.0;
  const auto panel = make_panel(mat, kinds(), .8 / 6, 6);
  EXPECT_DOUBLE_EQ(panel.initial_thickness_mm, 1.1 + .8 + 2.0);
  EXPECT_EQ(panel.top_mm, panel.initial_thickness_mm);
  const std::array<int, 3> points{8, 6, 15};  // 8.25, 6, 15
  const std::array<double, 4> faces{0, 1.1, 1.9, 3.9};
  for (const auto& s : panel.strands) {
    const auto row = static_cast<std::size_t>(s.row);
    EXPECT_EQ(s.lattice.counts[1], points[row]);
    EXPECT_NEAR(s.lattice.thickness(), faces[row + 1] - faces[row], 1e-13);
    EXPECT_NEAR(s.points.x.front()[1] - s.lattice.spacing[1] / 2, faces[row], 1e-13);
    EXPECT_NEAR(s.points.x.back()[1] + s.lattice.spacing[1] / 2, faces[row + 1], 1e-13);
    EXPECT_NEAR(s.lattice.spacing[1], .8 / 6, .04 * .8 / 6);
  }
  EXPECT_NEAR(thinnest_strand(panel), .8, 1e-15);
}

// The press sees softened wood, the tests the material's own stiffness.
TEST(MakePanel, StrandsAreSoftenedAsTheirKind) {
  auto soft = kinds();
  soft[0].yield_factor = .5;
  soft[0].stiffness_factor = .25;
  const auto s = make_panel(one_strand(0, 100), soft, .4, 3).strands[0];
  const auto cold = wood::in_strand_axes(wood::library()[0], 0);
  EXPECT_EQ(s.material.stiffness, cold.stiffness);
  EXPECT_EQ(s.stiffness_factor, .25);
  EXPECT_LT((s.material.yield_surface - 4 * cold.yield_surface).norm(), 1e-15);
  EXPECT_EQ(s.material.hardening.hill.K, 60);
}

// The law is the kind's, also for a strand that names a material of its own; densified wood starts crushed.
TEST(MakePanel, StrandsYieldByTheLawOfTheirKind) {
  auto crushing = kinds();
  EXPECT_EQ(make_panel(one_strand(0, 100), crushing, .4, 3).strands[0].material.law(), wood::Law::kHill);
  crushing[0].material.law = wood::Law::kCrushing;
  auto mat = one_strand(0, 100);
  const auto plain = make_panel(mat, crushing, .4, 3).strands[0];
  EXPECT_EQ(plain.material.law(), wood::Law::kCrushing);
  EXPECT_EQ(plain.points.plastic[0], 0);
  mat.layers[0].strands[0].material = "vtc";
  const auto dense = make_panel(mat, crushing, .4, 3).strands[0];
  EXPECT_EQ(dense.material.law(), wood::Law::kCrushing);
  for (const double x : dense.points.plastic) EXPECT_NEAR(x, 1 - 350.0 / 910, 1e-15);
}

// Rows off the grain: held (six stresses in a section) or free to shear across (four).
TEST(MakePanel, RowsOffTheGrainAreHeldOrFreeToShear) {
  auto turned = kinds();
  turned[0].angle_deg = 30;
  const auto held = make_panel(one_strand(0, 100), turned, .4, 3).strands[0].material;
  turned[0].off_axis = wood::OffAxis::kUncoupled;
  const auto freed = make_panel(one_strand(0, 100), turned, .4, 3).strands[0].material;
  EXPECT_GT(std::abs(held.stiffness(0, 5)), 1000);
  EXPECT_EQ(freed.stiffness(0, 5), 0);
  EXPECT_LT(freed.stiffness(0, 0), 0.5 * held.stiffness(0, 0));
}

// Length x thickness x density: 100 mm of .8 mm poplar, over it 60 mm of 1.5 mm VTC and 20 mm of the same row in
// poplar.
TEST(Weigh, CountsEveryStrandWithItsOwnMaterialAndThickness) {
  auto mat = one_strand(0, 100);
  mat.layers[1] = {"skin", {{0, 60, {}, {}, {}}, {70, 90, {}, "poplar", {}}}, {}, 1.5};
  const double poplar = 100 * .8 * 350, vtc = 60 * 1.5 * 910, mixed = 20 * 1.5 * 350, total = poplar + vtc + mixed;
  const auto weight = weigh(mat, kinds());
  EXPECT_NEAR(weight.kg_per_m2, total / 100 * 1e-3, 1e-12);
  ASSERT_EQ(weight.by_kind.size(), 2U);
  EXPECT_EQ(weight.by_kind[0].name, "surface");
  EXPECT_NEAR(weight.by_kind[0].fraction, poplar / total, 1e-14);
  EXPECT_EQ(weight.by_kind[1].name, "skin");
  EXPECT_NEAR(weight.by_kind[1].fraction, (vtc + mixed) / total, 1e-14);
  ASSERT_EQ(weight.by_material.size(), 2U);
  EXPECT_NEAR(weight.by_material[0].fraction, (poplar + mixed) / total, 1e-14);
  EXPECT_NEAR(weight.by_material[1].fraction, vtc / total, 1e-14);
}

TEST(MakePanel, UnknownRoleAndMaterialAreInputErrors) {
  auto mat = one_strand(0, 100);
  mat.layers[1].role = "surfaces";
  try {
    make_panel(mat, kinds(), 0.4, 3);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("layer 2: role \"surfaces\""), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("did you mean \"surface\"?"), std::string::npos) << error.what();
  }
  mat = one_strand(0, 100);
  mat.layers[1].strands[0].material = "popler";
  try {
    make_panel(mat, kinds(), 0.4, 3);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"popler\"; did you mean \"poplar\"?"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("Materials: \"poplar\", \"vtc\""), std::string::npos) << error.what();
  }
}

// Corners of an undeformed strand are the rectangle's lattice: i dx, j dy from its lower left corner.
TEST(Corners, OfAnUndeformedStrandAreExact) {
  const auto s = make_panel(one_strand(12.5, 31.7), kinds(), 0.3, 4).strands.at(1);
  const auto c = corners(s);
  ASSERT_EQ(c.size(), (static_cast<std::size_t>(s.lattice.counts[0]) + 1) * 5);
  for (int j = 0; j <= 4; ++j) {
    for (int i = 0; i <= s.lattice.counts[0]; ++i) {
      const auto& corner = c[static_cast<std::size_t>(i) +
                             (static_cast<std::size_t>(s.lattice.counts[0]) + 1) * static_cast<std::size_t>(j)];
      EXPECT_NEAR(corner[0], 12.5 + i * 19.2 / s.lattice.counts[0], 1e-12);
      EXPECT_NEAR(corner[1], 0.8 + 0.2 * j, 1e-12);
    }
  }
}

// Under x -> A x + b all domains that meet at a corner put it at the same place, so the mean is exact.
TEST(Corners, OfAnAffinelyDeformedStrandAreExact) {
  auto s = make_panel(one_strand(12.5, 31.7), kinds(), 0.3, 4).strands.at(0);
  const auto before = corners(s);
  Tensor<2> A;
  A << 1.03, 0.21, -0.15, 0.62;
  const Vec<2> b(3.5, -0.7);
  for (std::size_t p = 0; p < s.size(); ++p) {
    s.points.x[p] = A * s.points.x[p] + b;
    s.points.F[p] = A;
  }
  const auto after = corners(s);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LT((after[i] - (A * before[i] + b)).norm(), 1e-12) << i;
}

// The grain is a material line: it follows F a0 (.2 of shear turns it by atan .2), not the polar rotation (half of
// that).
TEST(Grain, FollowsTheMaterialLine) {
  Tensor<2> F;
  F << 1, 0.5, 0.2, 0.6;
  EXPECT_NEAR(std::atan2(grain<2>(F)[1], grain<2>(F)[0]), std::atan(0.2), 1e-15);
  EXPECT_NEAR(grain<2>(F).norm(), 1, 1e-15);
}

mat::PlateMat plate() {
  mat::PlateMat mat;
  mat.length_mm = 30;
  mat.width_mm = 20;
  mat.layer_thickness_mm = 0.8;
  for (const char* role : {"surface", "core"}) {
    auto& layer = mat.layers.emplace_back();
    layer.role = role;
    auto& strand = layer.strands.emplace_back();
    strand.cx_mm = 3;
    strand.cy_mm = 4;
    strand.length_mm = 13.3;
    strand.width_mm = 5.2;
  }
  mat.layers[1].thickness_mm = 1.6;
  return mat;
}

// A strand of a plate is a whole lattice, turned about its middle: points go on beyond the window's edge, F is the turn
// and the wood is that of the grain along the lattice.
TEST(MakePanel, TurnsTheStrandsOfAPlate) {
  const auto panel = make_panel(plate(), kinds(), 1, 2);
  EXPECT_TRUE(panel.periodic);
  EXPECT_EQ(panel.depth_mm, 20);
  EXPECT_NEAR(panel.thickness_mm(), 2.4, 1e-15);
  ASSERT_EQ(panel.strands.size(), 2U);
  const auto& core = panel.strands[1];
  EXPECT_EQ(core.lattice.counts, (std::array<int, 3>{13, 5, 4}));
  EXPECT_NEAR(core.lattice.extent(0), 13.3, 1e-13);
  EXPECT_EQ(core.angle_deg, 90);
  EXPECT_EQ(core.row, 1);
  Tensor<3> quarter;
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_EQ(core.points.F.front(), quarter);
  EXPECT_EQ(core.material.stiffness, wood::in_strand_axes(wood::library()[0], 0).stiffness);
  Vec<3> low = core.points.x.front(), high = low;
  for (const auto& x : corners(core)) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  EXPECT_LT((low - Vec<3>(3 - 2.6, 4 - 6.65, 0.8)).norm(), 1e-12);
  EXPECT_LT((high - Vec<3>(3 + 2.6, 4 + 6.65, 2.4)).norm(), 1e-12);
}

TEST(MakePanel, NamesTheStrandOfAPlateThatIsWrong) {
  auto mat = plate();
  mat.layers[1].strands[0].material = "poplr";
  try {
    make_panel(mat, kinds(), 1, 2);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()).rfind("layer 2, strand 1: unknown material \"poplr\"; did you mean \"poplar\"?", 0),
        0U)
        << error.what();
  }
}

}  // namespace
}  // namespace strandlab
