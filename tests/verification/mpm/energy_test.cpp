// Mass and energy of pressed mats.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "strandlab/mat/form.hpp"
#include "strandlab/press/press.hpp"
#include "support/report.hpp"

namespace strandlab::press {
namespace {

// Oriented strand board: bottom and top quarter surface rows, the others core rows.
mat::Mat strand_board(double length_mm, int rows) {
  mat::Layup layup;
  layup.length_mm = length_mm;
  for (int r = 0; r < rows; ++r) {
    if (r < rows / 4 || r >= rows - rows / 4)
      layup.rows.push_back({"surface", {150, 20, 15, 4.95}});
    else
      layup.rows.push_back({"core", {25, 3, 10, 1}});
  }
  return mat::form(layup, 3);
}

Panel<2> panel_of(const mat::Mat& mat) {
  const auto poplar = wood::library()[0];
  return make_panel(mat, {{"surface", poplar, 0}, {"core", poplar, 90}}, 0.8 / 6, 6);
}

// Presses at 16 m/s and checks at every half per cent of compaction from 1 % on that the platens' work is found again
// in the other terms, each summed from its own definition: within `limit` of it.
void expect_balance(const mat::Mat& mat, double compaction, double ramp, double courant, double limit) {
  const auto panel = panel_of(mat);
  mpm::Options options;
  options.courant = courant;
  Schedule schedule;
  schedule.compactions = {compaction};
  schedule.ramp_time_fraction = ramp;
  schedule.record_interval_compaction = 0.005;
  const auto outcome = press<2>(panel, schedule, setup<2>(panel, {}, mpm::Side::kRoller, options), {});
  double worst = 0;
  for (const auto& r : outcome.records) {
    if (r.compaction < 0.01) continue;
    worst = std::max(worst, std::abs(r.balance_error()));
    EXPECT_GT(r.plastic_mJ, 0) << "at C = " << r.compaction;
    EXPECT_GT(r.friction_mJ, 0) << "at C = " << r.compaction;
  }
  report(fmt::format("{} strands pressed to C = {}, Courant number {}: worst energy balance over the platens' work",
                     panel.strands.size(), compaction, courant),
         worst, below(limit));
}

TEST(Energy, PlatenWorkIsFoundAgainInAPressedSlice) {
  expect_balance(strand_board(10, 8), 0.4, 0.02, 0.4, 1e-4);
  expect_balance(strand_board(10, 8), 0.15, 0.05, 0.1, 3e-5);
}

// Twenty rows with gaps in the face rows: until the gaps close the strands fly and meet, and most of the work is
// kinetic.
TEST(Energy, PlatenWorkIsFoundAgainWhileStrandsMeetNightly) {
  expect_balance(strand_board(30, 20), 0.1, 0.08, 0.4, 1e-4);
}

// The mass on the grid is that of the strands as drawn, to round-off, in every step: density times length times
// thickness, per mm depth. What weights spread behind rollers is folded back, and mirror images do not count.
TEST(Mass, IsThatOfTheStrands) {
  const auto mat = strand_board(30, 8);
  double expected = 0;
  for (const auto& layer : mat.layers) {
    for (const auto& s : layer.strands) expected += 350e-12 * (s.x1_mm - s.x0_mm) * mat.layer_thickness_mm;
  }
  const auto panel = panel_of(mat);
  std::vector<mpm::Body<2>> bodies;
  for (const auto& strand : panel.strands) bodies.push_back(mpm::body_of(strand));
  const auto s = setup<2>(panel, {}, mpm::Side::kRoller, {});
  mpm::Engine<2> engine(bodies, s.grid, s.engine);
  engine.set_platens({panel.bottom_mm, 0}, {panel.top_mm, -16000});
  EXPECT_NEAR(engine.mass(), expected, 1e-13 * expected);
  double worst = 0;
  for (int k = 0; k < 300; ++k) {
    engine.step();
    worst = std::max(worst, std::abs(engine.grid_mass() / expected - 1));
  }
  report("mass on the grid over that of the strands, less 1: largest of 300 steps", worst,
         below(1e-12).because(test::kRoundOff));
}

}  // namespace
}  // namespace strandlab::press
