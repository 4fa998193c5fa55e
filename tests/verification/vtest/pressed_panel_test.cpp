// Virtual tests of a panel that was really pressed: undulated strands, closed gaps, strand corners that fold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "strandlab/mat/form.hpp"
#include "strandlab/press/press.hpp"
#include "support/report.hpp"
#include "verification/vtest/reference_panels.hpp"

namespace strandlab::vtest {
namespace {

// OSB of a number of rows, half of them core, on cells twice as long as high, pressed to 30 %.
Panel<2> pressed_osb(int rows, double length_mm) {
  mat::Layup layup;
  layup.length_mm = length_mm;
  for (int row = 0; row < rows; ++row) {
    mat::LayupRow surface{"surface", {}}, core{"core", {25, 3, 10, 1}};
    layup.rows.push_back(4 * row < rows || 4 * row >= 3 * rows ? surface : core);
  }
  const auto formed = panel_of(mat::form(layup, 3), 1.6 / 6);
  press::Resolution resolution;
  resolution.cell_aspect = 2;
  press::Schedule schedule;
  schedule.compactions = {0.3};
  std::optional<Panel<2>> pressed;
  press::Sink<2> sink;
  sink.snapshot = [&](const Panel<2>& panel, int) { pressed = panel; };
  press::press<2>(formed, schedule, press::setup<2>(formed, resolution, mpm::Side::kRoller, {}), sink);
  return pressed.value();
}

// A small panel: six elements through a strand in place of three change no modulus by .05 %.
TEST(PressedPanel, ModuliOfASmallPanelSettle) {
  const auto panel = pressed_osb(8, 20);
  EXPECT_NEAR(panel.compaction(), 0.3, 1e-3);
  Options options;
  options.compliance_t_mm_per_MPa = {0, 0.0105};
  const auto three = measure(panel, options);
  options.elements_through_strand = 6;
  const auto six = measure(panel, options);
  double largest = 0;
  for (std::size_t i = 0; i < six.moduli.size(); ++i)
    largest = std::max(largest, std::abs(six.moduli[i].modulus_MPa / three.moduli[i].modulus_MPa - 1));
  report("largest change of a modulus, 3 to 6 elements", 100 * largest, below(0.05), "%");
}

// Elements through a strand 3 -> 6 change no modulus by 3 %, 6 -> 12 by 1 %; energy and reactions agree; the penalty
// leaves no trace.
TEST(PressedPanel, ModuliSettleWithElementsNightly) {
  const auto panel = pressed_osb(20, 40);
  EXPECT_NEAR(panel.compaction(), 0.3, 1e-3);
  Options options;
  options.kinds = kinds_on_end_planes();
  options.compliance_t_mm_per_MPa = {0, 0.0105};
  std::vector<Result> results;
  for (const int elements : {3, 6, 12}) {
    options.elements_through_strand = elements;
    results.push_back(measure(panel, options));
    for (const auto& m : results.back().moduli) EXPECT_NEAR(m.modulus_MPa / m.reaction_modulus_MPa, 1, 1e-6);
  }
  options.elements_through_strand = 3;
  options.perfect_bond *= 10;
  const auto stiffer = measure(panel, options);
  for (std::size_t i = 0; i < stiffer.moduli.size(); ++i) {
    EXPECT_NEAR(results[1].moduli[i].modulus_MPa / results[0].moduli[i].modulus_MPa, 1, 0.03);
    EXPECT_NEAR(results[2].moduli[i].modulus_MPa / results[1].moduli[i].modulus_MPa, 1, 0.01);
    EXPECT_NEAR(stiffer.moduli[i].modulus_MPa / results[0].moduli[i].modulus_MPa, 1, 1e-4);
  }
}

}  // namespace
}  // namespace strandlab::vtest
