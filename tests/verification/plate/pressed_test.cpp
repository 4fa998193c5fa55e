// Plates that are pressed before they are cured and tested.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "strandlab/press/press.hpp"
#include "support/report.hpp"
#include "verification/plate/plates.hpp"

namespace strandlab::vtest {
namespace {

struct PressedPlate {
  std::vector<press::Record> records;
  Panel<3> panel;
};

// Two points per cell and axis, smooth platens, Hill's law.
PressedPlate press_plate(const mat::PlateMat& mat, double compaction, double cell_mm, double speed_m_s) {
  auto poplar = wood::library().front();
  poplar.law = wood::Law::kHill;
  const auto panel = make_panel(mat, kinds_of(poplar), cell_mm / 2, 6);
  press::Resolution resolution;
  resolution.cell_aspect = cell_mm / (thinnest_strand(panel) / resolution.cells_through_strand);
  mpm::Options options;
  options.platen_friction = 0;
  options.threads = 2;
  press::Schedule schedule;
  schedule.speed_m_s = speed_m_s;
  schedule.compactions = {compaction};
  schedule.record_interval_compaction = 0.005;
  PressedPlate pressed;
  press::Sink<3> sink;
  sink.snapshot = [&](const Panel<3>& panel_then, int) { pressed.panel = panel_then; };
  pressed.records =
      press::press<3>(panel, schedule, press::setup(panel, resolution, mpm::Side::kPeriodic, options), sink).records;
  return pressed;
}

double mean_stress(const std::vector<press::Record>& records, double from) {
  double sum = 0;
  int count = 0;
  for (const auto& r : records) {
    if (r.compaction < from) continue;
    sum += r.stress_MPa;
    ++count;
  }
  return sum / count;
}

struct AsIsAndTurned {
  PlateResult as_is, by_45;
};

AsIsAndTurned press_turned(const std::string& what, const mat::PlateMat& mat, double compaction, double cell_mm) {
  const auto as_is = press_plate(mat, compaction, cell_mm, 16);
  const auto by_45 = press_plate(turned_mat(mat, 1, 1), compaction, cell_mm, 16);
  const double from = compaction - 0.05;
  report(what + " turned by 45 degrees, press stress over that along the grid",
         mean_stress(by_45.records, from) / mean_stress(as_is.records, from), near(1, 0.04));
  const AsIsAndTurned tested{measure(as_is.panel, options(1, {0.0105})), measure(by_45.panel, options(1, {0.0105}))};
  report(what + " turned by 45 degrees and pressed, bonded area over that along the grid",
         tested.by_45.glued_area_mm2 / tested.as_is.glued_area_mm2 / 2, near(1, 0.03));
  return tested;
}

// A torus mat turned by 45 degrees is two copies of it on another torus: the whole chain, turned lattices in the engine
// included.
TEST(PressedPlate, SmallMatPressesAlikeTurnedBy45Degrees) {
  const auto tested = press_turned("small mat", small_mat(), 0.3, 0.8);
  report("small mat turned by 45 degrees and pressed, plate stiffness against the turned one, largest difference",
         largest_difference(tested.by_45.tensors[0].abd, turned(tested.as_is.tensors[0].abd, std::numbers::pi / 4)),
         below(0.08));
}

TEST(PressedPlate, NightlyReferenceMatPressesAlikeTurnedBy45Degrees) {
  press_turned("per_a", reference_plate("per_a"), 0.35, 1.07);
}

}  // namespace
}  // namespace strandlab::vtest
