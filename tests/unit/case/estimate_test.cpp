// What `strandlab check` says a case will cost, against what was measured (docs/performance.md) and what the engine
// takes.
#include "strandlab/case/estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "strandlab/press/press.hpp"

namespace strandlab::cases {
namespace {

// Within a factor of two: an estimate, not a promise.
void expect_about(double estimated, double measured, const char* what) {
  EXPECT_LT(std::abs(std::log(estimated / measured)), std::log(2.0))
      << what << ": estimated " << estimated << ", measured " << measured;
}

struct Slice {  // 20 mm of the OSB case
  Case c = ready_case("osb");
  Panel<2> panel;
  Estimate e;
  Slice() {
    c.length_mm = 20;
    c.threads = 1;
    const auto mat = make_mat(c);
    settle_states(c, mat);
    panel = make_panel(c, mat);
    e = estimate(c, panel);
  }
};

// Mid-press on one thread the engine needs 55.4 ns per particle-step.
TEST(Estimate, OfTimeIsOfTheOrderMeasured) {
  const Slice slice;
  expect_about(1e9 * slice.e.press_s / (static_cast<double>(slice.e.particles) * slice.e.steps), 55.4,
               "ns per particle-step");
}

// Assembly, factorisation and two tests of 25,000 elements (50,000 unknowns) take .19 s for each 1/D_t; beside those of
// the case three more say how much the moduli hang on the gap that is glued.
TEST(Estimate, OfVirtualTestsIsOfTheOrderMeasured) {
  Slice slice;
  slice.c.length_mm = 100;  // about 19,000 elements
  slice.c.schedule.compactions = {0.2};
  slice.c.test.compliance_t_mm_per_MPa = {0};
  slice.c.test.elements_through_strand = 3;
  slice.c.grid.cell_aspect = 1;
  slice.panel = make_panel(slice.c, make_mat(slice.c));
  expect_about(estimate(slice.c, slice.panel).test_s, (1 + 3) * 0.19 * 19 / 25, "s of one 1/D_t");
}

// Runs of 30 and 100 mm of the OSB case with its tests, 15,126 and 49,554 particles: 97 and 183 MB at their largest
// (maxrss), 66 and 118 MB on disk.
TEST(Estimate, OfMemoryAndDiskIsWhatRunsTook) {
  const auto of_length = [](double length_mm) {
    Slice slice;
    slice.c.length_mm = length_mm;
    const auto mat = make_mat(slice.c);
    settle_states(slice.c, mat);
    return estimate(slice.c, make_panel(slice.c, mat));
  };
  const auto small = of_length(30), large = of_length(100);
  expect_about(small.memory_bytes, 97e6, "memory of 30 mm");
  expect_about(large.memory_bytes, 183e6, "memory of 100 mm");
  expect_about(large.memory_bytes - small.memory_bytes, 183e6 - 97e6, "memory of 70 mm more");
  expect_about(small.disk_bytes, 66e6, "disk of 30 mm");
  expect_about(large.disk_bytes, 118e6, "disk of 100 mm");
}

// The ready hot-pressed board, 60 mm of seed 3: 50,484 particles, 108,591 steps, 2.21 ms in the engine.
TEST(Estimate, OfAHotPressingIsWhatOneTook) {
  auto c = ready_case("hot_osb");
  c.seed = 3;
  const auto mat = make_mat(c);
  settle_states(c, mat);
  const auto e = estimate(c, make_panel(c, mat));
  EXPECT_EQ(e.particles, 50484U);
  expect_about(e.pressing_time_s, 2.211e-3, "engine's time");
  expect_about(e.steps, 108591, "steps");
}

// The engine itself, after a step.
TEST(Estimate, OfTheTimeStepIsWhatTheEngineTakes) {
  const Slice slice;
  const auto setup = press::setup(slice.panel, slice.c.grid, mpm::Side::kRoller, slice.c.mpm);
  std::vector<mpm::Body<2>> bodies;
  for (const auto& s : slice.panel.strands) bodies.push_back(mpm::body_of(s));
  mpm::Engine<2> engine(bodies, setup.grid, setup.engine);
  engine.set_platens({0, 0}, {slice.panel.top_mm, 0});
  engine.step();
  EXPECT_EQ(slice.e.particles, engine.particles());
  expect_about(slice.e.time_step_s, engine.state().time_step_s, "time step");
}

}  // namespace
}  // namespace strandlab::cases
