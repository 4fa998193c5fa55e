// Strands of a pressed mat keep apart: their outlines overlap by next to nothing.
#include <gtest/gtest.h>

#include <array>

#include "strandlab/mat/form.hpp"
#include "strandlab/press/press.hpp"
#include "strandlab/report/morphology.hpp"
#include "support/record.hpp"

namespace strandlab::report {
namespace {

// Eight rows of an OSB mat, 30 mm long, with gaps that the rows beside them are pushed into, on the main job's default
// cells. The exact intersections of all strands' polygons, together, over the area of the panel.
TEST(PressedStrands, HardlyOverlap) {
  const mat::StrandStatistics surface{150, 20, 15, 4.95}, core{25, 3, 10, 1};
  mat::Layup layup;
  layup.length_mm = 30;
  for (int row = 0; row < 8; ++row) {
    if (row < 2 || row >= 6)
      layup.rows.push_back({"surface", surface});
    else
      layup.rows.push_back({"core", core});
  }
  const auto poplar = wood::library().front();
  const auto mat = make_panel(mat::form(layup, 2), {{"surface", poplar, 0}, {"core", poplar, 90}}, 0.2, 6);
  const auto setup = press::setup(mat, press::Resolution{3, 1.5, true}, mpm::Side::kRoller, mpm::Options{});
  press::Schedule schedule;
  schedule.compactions = {0.1, 0.2, 0.3, 0.4};
  press::Sink<2> sink;
  const std::array<double, 4> limits{0.001, 0.005, 0.01, 0.015};
  int kept = 0;
  sink.snapshot = [&](const Panel<2>& panel, int index) {
    const Areas shares = areas(panel);
    ++kept;
    EXPECT_LT(shares.overlap, kExplainedOverlap) << "compaction " << panel.compaction();
    EXPECT_GT(shares.strands, 0.7);
    const auto when = std::to_string(10 * (index + 1)) + " %";
    test::record("all overlaps of strands over the panel, pressed by " + when, shares.overlap,
                 test::below(limits[static_cast<std::size_t>(index)]));
  };
  press::press<2>(mat, schedule, setup, sink);
  EXPECT_EQ(kept, 4);
}

}  // namespace
}  // namespace strandlab::report
