// What `strandlab check` says a case will cost, against what was measured (docs/performance.md) and what the engine
// takes.
#include "strandlab/case/estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "strandlab/press/press.hpp"

namespace strandlab::cases {
namespace {

// Within a factor of five: an estimate, not a promise.
void expect_about(double estimated, double measured, const char* what) {
  EXPECT_LT(std::abs(std::log(estimated / measured)), std::log(5.0))
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

// Assembly, factorisation and two tests of 25,000 elements (50,000 unknowns) take .19 s for each 1/D_t.
TEST(Estimate, OfVirtualTestsIsOfTheOrderMeasured) {
  Slice slice;
  slice.c.length_mm = 100;  // about 19,000 elements
  slice.c.schedule.compactions = {0.2};
  slice.c.test.compliance_t_mm_per_MPa = {0};
  slice.c.test.elements_through_strand = 3;
  slice.c.grid.cell_aspect = 1;
  slice.panel = make_panel(slice.c, make_mat(slice.c));
  expect_about(estimate(slice.c, slice.panel).test_s, 0.19 * 19 / 25, "s of one 1/D_t");
}

// The engine itself, after a step: its time step and the memory it holds for each particle.
TEST(Estimate, OfStepsAndMemoryIsWhatTheEngineTakes) {
  const Slice slice;
  const auto setup = press::setup(slice.panel, slice.c.grid, mpm::Side::kRoller, slice.c.mpm);
  std::vector<mpm::Body<2>> bodies;
  for (const auto& s : slice.panel.strands) bodies.push_back(mpm::body_of(s));
  mpm::Engine<2> engine(bodies, setup.grid, setup.engine);
  engine.set_platens({0, 0}, {slice.panel.top_mm, 0});
  engine.step();
  const auto particles = static_cast<double>(engine.particles());
  EXPECT_EQ(slice.e.particles, engine.particles());
  expect_about(slice.e.time_step_s, engine.state().time_step_s, "time step");
  expect_about((slice.e.memory_bytes - 5e7) / particles, static_cast<double>(engine.bytes()) / particles,
               "bytes per particle");
}

}  // namespace
}  // namespace strandlab::cases
