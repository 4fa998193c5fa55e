// The builds of the kernels for different processors are one program: they differ in rounding only.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "strandlab/mat/form.hpp"
#include "strandlab/mpm/dispatch.hpp"
#include "support/environment.hpp"
#include "support/report.hpp"
#include "verification/press/stacks.hpp"

namespace strandlab::press_tests {
namespace {

// Four full rows, along and across, by both laws of yielding, one of them at 30 degrees (six stress components).
Panel<2> stack() {
  constexpr double kRow = 0.8;
  Panel<2> panel;
  panel.length_mm = 1.6;
  panel.initial_thickness_mm = panel.top_mm = 4 * kRow;
  for (int row = 0; row < 4; ++row) {
    auto wood = poplar(true);
    if (row % 2) wood.law = wood::Law::kCrushing;
    const double angle = row == 0 ? 0 : row == 3 ? 30 : 90;
    panel.strands.push_back(
        strand<2>(wood, angle, row, Vec<2>(0, row * kRow), Vec<2>(panel.length_mm, (row + 1) * kRow), {12, 6}));
  }
  return panel;
}

// The OSB case on 10 mm: five rows of its twenty, gaps, ends that meet.
Panel<2> slice() {
  mat::Layup layup;
  layup.length_mm = 10;
  const mat::LayupRow surface{"surface", {150, 20, 15, 4.95}}, core{"core", {25, 3, 10, 1}};
  layup.rows = {surface, core, core, core, surface};
  const auto wood = poplar(true);
  return make_panel(mat::form(layup, 3), {{"surface", wood, 0}, {"core", wood, 90}}, 0.8 / 6, 6);
}

struct PressedBy {
  Panel<2> panel;
  std::vector<press::Record> records;
};

PressedBy press_on(const std::string& set, const Panel<2>& panel, double compaction) {
  const test::EnvironmentVariable variable(mpm::kInstructionSetVariable, set.c_str());
  press::Schedule schedule;
  schedule.compactions = {compaction};
  schedule.record_interval_compaction = 0.005;
  PressedBy pressed;
  press::Sink<2> sink;
  sink.snapshot = [&](const Panel<2>& state, int) { pressed.panel = state; };
  pressed.records =
      press::press<2>(panel, schedule, press::setup(panel, {}, mpm::Side::kRoller, mpm::Options{}), sink).records;
  return pressed;
}

void expect_one_program(const std::string& what, const Panel<2>& panel, double compaction) {
  const PressedBy reference = press_on("generic", panel, compaction);
  for (const auto& set : mpm::instruction_sets()) {
    if (set == "generic") continue;
    const PressedBy other = press_on(set, panel, compaction);
    ASSERT_EQ(other.records.size(), reference.records.size());
    double moved = 0, stress = 0, largest = 0;
    for (std::size_t s = 0; s < panel.strands.size(); ++s) {
      const auto &a = other.panel.strands[s], &b = reference.panel.strands[s];
      for (std::size_t p = 0; p < a.size(); ++p) moved = std::max(moved, (a.points.x[p] - b.points.x[p]).norm());
    }
    for (std::size_t i = 0; i < reference.records.size(); ++i) {
      stress = std::max(stress, std::abs(other.records[i].stress_MPa - reference.records[i].stress_MPa));
      largest = std::max(largest, std::abs(reference.records[i].stress_MPa));
    }
    EXPECT_GT(largest, 1);
    report(fmt::format("{}, {} against generic kernels: positions", what, set), moved,
           below(1e-11).because(test::kRoundOff), "mm");
    report(fmt::format("{}, {} against generic kernels: platen stress over its peak", what, set), stress / largest,
           below(1e-11).because(test::kRoundOff));
  }
}

TEST(InstructionSets, PressAStackAlike) {
  expect_one_program("stack of both laws pressed by 20 %", stack(), 0.2);
}

TEST(InstructionSets, PressASliceOfOSBAlike) {
  expect_one_program("five rows of OSB, 10 mm, pressed by 15 %", slice(), 0.15);
}

}  // namespace
}  // namespace strandlab::press_tests
