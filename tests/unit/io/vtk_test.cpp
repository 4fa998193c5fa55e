#include "strandlab/io/vtk.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "strandlab/core/error.hpp"
#include "support/strands.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::io {
namespace {

using test::contents;
using test::TemporaryFolder;

template <int Dim>
Strand<Dim> block(const std::array<int, Dim>& points, const Vec<Dim>& spacing, const Vec<Dim>& origin) {
  wood::StrandMaterial material;
  material.density = 350 * kTonnePerMm3;
  return test::strand_from<Dim>(material, origin, spacing, points);
}

// Reads an array of the file back, independently of the writer: base64 by table look-up, UInt64 size, then the values.
template <class Value>
std::vector<Value> array_of(const std::string& file, const std::string& name) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t head = file.find("Name=\"" + name + "\""), begin = file.find('>', head) + 1;
  EXPECT_NE(head, std::string::npos) << name;
  std::string bytes;
  std::uint32_t bits = 0;
  int held = 0;
  for (std::size_t i = begin; file[i] != '<' && file[i] != '='; ++i) {
    bits = bits << 6U | static_cast<std::uint32_t>(digits.find(file[i]));
    held += 6;
    if (held >= 8) bytes += static_cast<char>(bits >> (held -= 8) & 255U);
  }
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data(), sizeof size);
  EXPECT_EQ(bytes.size(), size + sizeof size) << name;
  std::vector<Value> values(size / sizeof(Value));
  std::memcpy(values.data(), bytes.data() + sizeof size, size);
  return values;
}

TEST(Vtu, SectionHasOneQuadPerPoint) {
  const TemporaryFolder folder;
  Panel<2> panel;
  panel.strands = {block<2>({3, 2}, {0.5, 0.25}, {1, 2}), block<2>({2, 1}, {0.5, 0.5}, {1, 2.5})};
  panel.strands[1].row = 1;
  panel.strands[1].points.F[1] = Tensor<2>{{1, 0}, {0, 0.5}};
  panel.strands[1].points.stress[1] = Voigt{-1, -2, -3, 0, 0.5, 0};
  panel.strands[1].points.plastic[1] = 0.125;
  panel.strands[1].points.v[1] = Vec<2>(2000, -500);
  write_vtu(panel, folder / "p.vtu");
  const std::string file = contents(folder / "p.vtu");
  EXPECT_NE(file.find("<Piece NumberOfPoints=\"18\" NumberOfCells=\"8\">"), std::string::npos);  // 4 x 3 + 3 x 2
  const auto points = array_of<float>(file, "position_mm");
  const auto cells = array_of<std::int64_t>(file, "connectivity");
  ASSERT_EQ(points.size(), 18U * 3U);
  ASSERT_EQ(cells.size(), 8U * 4U);
  EXPECT_EQ((std::vector<std::int64_t>(cells.begin() + 16, cells.begin() + 20)),
            (std::vector<std::int64_t>{5, 6, 10, 9}));
  // Cell (1, 1) of the first strand: x 1.5..2, y 2.25..2.5.
  EXPECT_EQ(points[3 * 5], 1.5F);
  EXPECT_EQ(points[3 * 5 + 1], 2.25F);
  EXPECT_EQ(points[3 * 10], 2.0F);
  EXPECT_EQ(points[3 * 10 + 1], 2.5F);
  EXPECT_EQ(array_of<std::int64_t>(file, "offsets").back(), 32);
  EXPECT_EQ(array_of<std::uint8_t>(file, "types"), std::vector<std::uint8_t>(8, 9));
  EXPECT_EQ(array_of<float>(file, "density_kg_m3"), (std::vector<float>{350, 350, 350, 350, 350, 350, 350, 700}));
  EXPECT_EQ(array_of<std::int32_t>(file, "strand_id"), (std::vector<std::int32_t>{0, 0, 0, 0, 0, 0, 1, 1}));
  EXPECT_EQ(array_of<std::int32_t>(file, "row"), (std::vector<std::int32_t>{0, 0, 0, 0, 0, 0, 1, 1}));
  EXPECT_EQ(array_of<float>(file, "plastic_strain").back(), 0.125F);
  const auto stress = array_of<float>(file, "stress_MPa");  // Kirchhoff over J = 1/2, across is -z, through is y
  EXPECT_EQ((std::vector<float>(stress.end() - 6, stress.end())), (std::vector<float>{-2, -6, -4, 1, 0, 0}));
  const auto velocity = array_of<float>(file, "velocity_m_s");
  EXPECT_EQ((std::vector<float>(velocity.end() - 3, velocity.end())), (std::vector<float>{2, -0.5F, 0}));
}

// Kinds and materials by name, displacements since the panel was formed, the laid angle under a name of its own.
TEST(Vtu, SaysWhatItShows) {
  const TemporaryFolder folder;
  Panel<2> formed;
  formed.initial_thickness_mm = 2;
  formed.top_mm = 2;
  formed.strands = {block<2>({2, 1}, {0.5, 0.5}, {0, 0}), block<2>({2, 1}, {0.5, 0.5}, {0, 1})};
  formed.strands[0].kind = "surface";
  formed.strands[1].kind = "a<b";
  formed.strands[1].angle_deg = 30;
  auto panel = formed;
  panel.top_mm = 1.5;
  panel.time_s = 0.002;
  for (auto& x : panel.strands[1].points.x) x += Vec<2>(0.25, -0.5);
  write_annotated_vtu<2>(panel, {&formed, {{"surface", "oak"}}}, folder / "p.vtu");
  const std::string file = contents(folder / "p.vtu");
  const auto moved = array_of<float>(file, "displacement_mm");
  ASSERT_EQ(moved.size(), 2U * 6U * 3U);
  EXPECT_EQ((std::vector<float>(moved.begin(), moved.begin() + 3)), (std::vector<float>{0, 0, 0}));
  EXPECT_EQ((std::vector<float>(moved.end() - 3, moved.end())), (std::vector<float>{0.25F, -0.5F, 0}));
  EXPECT_EQ(array_of<std::int32_t>(file, "kind"), (std::vector<std::int32_t>{0, 0, 1, 1}));
  EXPECT_EQ(array_of<float>(file, "laid_angle_deg"), (std::vector<float>{0, 0, 30, 30}));
  for (const char* part :
       {"Name=\"compaction\" NumberOfTuples=\"1\" format=\"ascii\">0.25<",
        "Name=\"time_ms\" NumberOfTuples=\"1\" format=\"ascii\">2<",
        "Name=\"kinds\" NumberOfTuples=\"2\" format=\"ascii\">115 117 114 102 97 99 101 0 97 60 98 0 <",
        "Name=\"materials\" NumberOfTuples=\"2\" format=\"ascii\">111 97 107 0 0 <"})
    EXPECT_NE(file.find(part), std::string::npos) << part;
}

// Two strands meet twice, with a gap between: two lines. Points of other strands begin a line of their own.
TEST(Vtu, GlueLinesAreSegmentsBetweenTheirPoints) {
  const TemporaryFolder folder;
  std::vector<GlueLinePoint> points;
  for (const double x : {0.0, 1.0, 2.0, 9.0, 10.0}) points.push_back({0, 1, {x, 1}, x});
  points.push_back({1, 2, {10, 2}, 7});
  write_glue_vtu(points, folder / "g.vtu");
  const std::string file = contents(folder / "g.vtu");
  EXPECT_NE(file.find("<Piece NumberOfPoints=\"6\" NumberOfCells=\"3\">"), std::string::npos);
  EXPECT_EQ(array_of<std::int64_t>(file, "connectivity"), (std::vector<std::int64_t>{0, 1, 1, 2, 3, 4}));
  EXPECT_EQ(array_of<std::int32_t>(file, "strand_b"), (std::vector<std::int32_t>{1, 1, 1}));
  EXPECT_EQ(array_of<float>(file, "slip_mm_per_strain"), (std::vector<float>{0, 1, 2, 9, 10, 7}));
}

TEST(Vtu, PanelHasOneHexahedronPerPoint) {
  const TemporaryFolder folder;
  Panel<3> panel;
  panel.strands = {block<3>({2, 3, 2}, {1, 2, 0.5}, {0, 0, 0})};
  write_vtu(panel, folder / "p.vtu");
  const std::string file = contents(folder / "p.vtu");
  EXPECT_NE(file.find("<Piece NumberOfPoints=\"36\" NumberOfCells=\"12\">"), std::string::npos);
  const auto points = array_of<float>(file, "position_mm");
  const auto cells = array_of<std::int64_t>(file, "connectivity");
  ASSERT_EQ(cells.size(), 12U * 8U);
  EXPECT_EQ(array_of<std::uint8_t>(file, "types"), std::vector<std::uint8_t>(12, 12));
  // The volume of every cell, from three of its edges, is that of the material point: 1 mm^3; right-handed.
  for (std::size_t c = 0; c < 12; ++c) {
    const auto corner = [&](std::size_t k) {
      const auto p = static_cast<std::size_t>(3 * cells[8 * c + k]);
      return Vec<3>(points[p], points[p + 1], points[p + 2]);
    };
    Tensor<3> edges;
    edges << corner(1) - corner(0), corner(3) - corner(0), corner(4) - corner(0);
    EXPECT_NEAR(edges.determinant(), 1, 1e-6);
    EXPECT_NEAR((corner(6) - corner(7) - corner(1) + corner(0)).norm(), 0, 1e-6);
  }
}

TEST(Pvd, ListsStatesByCompaction) {
  const TemporaryFolder folder;
  write_pvd({{0, "panel_0.vtu"}, {0.1, "a&b.vtu"}}, folder / "run.pvd");
  const std::string file = contents(folder / "run.pvd");
  EXPECT_NE(file.find("<DataSet timestep=\"0\" part=\"0\" file=\"panel_0.vtu\"/>"), std::string::npos);
  EXPECT_NE(file.find("<DataSet timestep=\"0.1\" part=\"0\" file=\"a&amp;b.vtu\"/>"), std::string::npos);
}

TEST(Vtu, FolderThatIsMissingIsBadInput) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_vtu(Panel<2>{}, folder / "none" / "p.vtu"), InputError);
}

}  // namespace
}  // namespace strandlab::io
