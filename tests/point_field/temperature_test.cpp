// A field more in the table, the temperature of the points: kept in checkpoints, cut with a specimen, lumped for
// frames, seen by ParaView and by the report's colourings, with no line about it but its row (CMakeLists.txt).
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "strandlab/files/hdf5.hpp"
#include "strandlab/io/checkpoint.hpp"
#include "strandlab/io/vtk.hpp"
#include "strandlab/panel/lumped.hpp"
#include "strandlab/report/frames.hpp"
#include "strandlab/vtest/window.hpp"
#include "support/strands.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab {
namespace {

using test::TemporaryFolder;

// A strand of 10 mm by 1 mm from x = -2 to 8 mm in a window of 8 mm, 100 degrees at x = 0 and 5 degrees more each mm.
Panel<2> warm_panel() {
  Panel<2> panel;
  panel.length_mm = 8;
  panel.initial_thickness_mm = panel.top_mm = 1;
  wood::StrandMaterial material;
  material.density = 350 * kTonnePerMm3;
  panel.strands = {test::strand_between<2>(material, Vec<2>(-2, 0), Vec<2>(8, 1), {20, 4})};
  auto& points = panel.strands[0].points;
  for (std::size_t p = 0; p < points.size(); ++p) points.temperature[p] = 100 + 5 * points.x[p][0];
  return panel;
}

TEST(AddedField, IsKeptInCheckpoints) {
  const TemporaryFolder folder;
  press::Checkpoint<2> checkpoint;
  checkpoint.panel = warm_panel();
  io::write_checkpoint(checkpoint, "", folder / "checkpoint.h5");
  const auto back = io::read_checkpoint<2>(folder / "checkpoint.h5", "");
  EXPECT_EQ(back.panel.strands[0].points.temperature, checkpoint.panel.strands[0].points.temperature);
  EXPECT_EQ(files::hdf5::Reader(folder / "checkpoint.h5").doubles("/panel/points/temperature_C", {80}),
            checkpoint.panel.strands[0].points.temperature);
}

// The specimen's points are new ones, 16 columns from x = 0 to 8: each as warm as its place.
TEST(AddedField, IsCutWithTheSpecimen) {
  const auto specimen = vtest::cut_to_window(warm_panel());
  const auto& points = specimen.panel.strands.at(0).points;
  ASSERT_EQ(points.size(), 64U);
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_NEAR(points.temperature[p], 100 + 5 * points.x[p][0], 1e-12);
  }
}

// Coarse points are as warm as the wood they cover, on the mean: a linear field stays one.
TEST(AddedField, IsLumpedForFrames) {
  const auto coarse = lumped(warm_panel(), 2, 2);
  const auto& points = coarse.strands.at(0).points;
  ASSERT_EQ(points.size(), 10U);
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_NEAR(points.temperature[p], 100 + 5 * points.x[p][0], 1e-12);
  }
}

TEST(AddedField, IsShownByParaView) {
  const TemporaryFolder folder;
  io::write_vtu(warm_panel(), folder / "panel.vtu");
  EXPECT_NE(test::contents(folder / "panel.vtu").find("Name=\"temperature_C\""), std::string::npos);
}

TEST(AddedField, IsAColouringOfTheReport) {
  const auto frames = report::pack_frames({warm_panel()}, {});
  for (const auto& field : frames.at("fields")) {
    if (field.at("key") != "temperature_C") continue;
    EXPECT_NEAR(field.at("low").get<double>(), 91.25, 1e-9);  // at x = -1.75
    EXPECT_NEAR(field.at("high").get<double>(), 138.75, 1e-9);
    return;
  }
  FAIL() << "no colouring of that name";
}

}  // namespace
}  // namespace strandlab
