// A field more in the table, the tracer in the points: kept in checkpoints, cut with a specimen, lumped for
// frames, seen by ParaView and by the report's colourings, with no line about it but its row (CMakeLists.txt).
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "strandlab/files/hdf5.hpp"
#include "strandlab/io/checkpoint.hpp"
#include "strandlab/io/vtk.hpp"
#include "strandlab/panel/lumped.hpp"
#include "strandlab/report/frames.hpp"
#include "strandlab/vtest/specimen.hpp"
#include "support/strands.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab {
namespace {

using test::TemporaryFolder;

// A strand of 10 mm by 1 mm from x = -2 to 8 mm in a window of 8 mm, 100 ppm at x = 0 and 5 ppm more each mm.
Panel<2> marked_panel() {
  Panel<2> panel;
  panel.length_mm = 8;
  panel.initial_thickness_mm = panel.top_mm = 1;
  wood::StrandMaterial material;
  material.density = 350 * kTonnePerMm3;
  panel.strands = {test::strand_between<2>(material, Vec<2>(-2, 0), Vec<2>(8, 1), {20, 4})};
  auto& points = panel.strands[0].points;
  for (std::size_t p = 0; p < points.size(); ++p) points.tracer[p] = 100 + 5 * points.x[p][0];
  return panel;
}

TEST(AddedField, IsKeptInCheckpoints) {
  const TemporaryFolder folder;
  press::Checkpoint<2> checkpoint;
  checkpoint.panel = marked_panel();
  io::write_checkpoint(checkpoint, "", folder / "checkpoint.h5");
  const auto back = io::read_checkpoint<2>(folder / "checkpoint.h5", "");
  EXPECT_EQ(back.panel.strands[0].points.tracer, checkpoint.panel.strands[0].points.tracer);
  EXPECT_EQ(files::hdf5::Reader(folder / "checkpoint.h5").doubles("/panel/points/tracer_ppm", {80}),
            checkpoint.panel.strands[0].points.tracer);
}

// The specimen's points are new ones, 16 columns from x = 0 to 8: each has what its place has.
TEST(AddedField, IsCutWithTheSpecimen) {
  const auto specimen = vtest::cut_to_window(marked_panel());
  const auto& points = specimen.panel.strands.at(0).points;
  ASSERT_EQ(points.size(), 64U);
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_NEAR(points.tracer[p], 100 + 5 * points.x[p][0], 1e-12);
  }
}

// Coarse points have what the wood they cover has, on the mean: a linear field stays one.
TEST(AddedField, IsLumpedForFrames) {
  const auto coarse = lumped(marked_panel(), 2, 2);
  const auto& points = coarse.strands.at(0).points;
  ASSERT_EQ(points.size(), 10U);
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_NEAR(points.tracer[p], 100 + 5 * points.x[p][0], 1e-12);
  }
}

TEST(AddedField, IsShownByParaView) {
  const TemporaryFolder folder;
  io::write_vtu(marked_panel(), folder / "panel.vtu");
  EXPECT_NE(test::contents(folder / "panel.vtu").find("Name=\"tracer_ppm\""), std::string::npos);
}

TEST(AddedField, IsAColouringOfTheReport) {
  const auto frames = report::pack_frames({marked_panel()}, {});
  for (const auto& field : frames.at("fields")) {
    if (field.at("key") != "tracer_ppm") continue;
    EXPECT_NEAR(field.at("low").get<double>(), 91.25, 1e-9);  // at x = -1.75
    EXPECT_NEAR(field.at("high").get<double>(), 138.75, 1e-9);
    return;
  }
  FAIL() << "no colouring of that name";
}

}  // namespace
}  // namespace strandlab
