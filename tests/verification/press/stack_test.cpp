// A stack of flat strands without gaps between rollers is a column in uniaxial strain: its pressing curve is known in
// closed form.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "support/report.hpp"
#include "verification/press/stacks.hpp"

namespace strandlab::press_tests {
namespace {

TEST(ConfinedStrand, AgreesWithTheTabulatedHillCurve) {
  const ConfinedStrand confined(poplar(true));  // check values of an independent integration, MPa
  const std::vector<std::pair<double, double>> table{{.01, 9.700},  {.05, 33.513}, {.1, 67.778},
                                                     {.2, 155.804}, {.3, 281.705}, {.4, 469.821}};
  for (const auto& [C, stress] : table) EXPECT_NEAR(confined.hill(C) / stress, 1, 2e-4) << "C = " << C;
}

struct Case {
  double offset_cells;
  bool follow;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << "grid offset " << c.offset_cells << (c.follow ? ", grid follows the platens" : ", fixed grid");
}

class Stack : public testing::TestWithParam<Case> {
 protected:
  // Four rows of 0.8 mm, 3 cells and 6 points through each, pressed slowly enough that inertia plays no part.
  static press::Outcome<2> run(bool yields) {
    constexpr int kRows = 4, kColumns = 6;
    constexpr double kRow = 0.8, kCell = kRow / 3;
    Panel<2> panel;
    panel.length_mm = kColumns * kCell;
    panel.initial_thickness_mm = panel.top_mm = kRows * kRow;
    for (int row = 0; row < kRows; ++row) {
      panel.strands.push_back(strand<2>(poplar(yields), 0, row, Vec<2>(0, row * kRow),
                                        Vec<2>(panel.length_mm, (row + 1) * kRow), {2 * kColumns, 6}));
    }
    mpm::Options options;
    options.friction = options.platen_friction = 0;
    press::Resolution resolution;
    resolution.follow_platens = GetParam().follow;
    auto setup = press::setup(panel, resolution, mpm::Side::kRoller, options);
    setup.grid.origin[1] -= GetParam().offset_cells * setup.grid.cell[1];
    press::Schedule schedule;
    schedule.speed_m_s = 4;
    schedule.ramp_time_fraction = 0.1;
    schedule.compactions = {0, 0.4};
    schedule.record_interval_compaction = 0.002;
    return press::press<2>(panel, schedule, setup, {});
  }

  // Stress within 2 % from C = .1 on; below, the compaction at which the closed form has the measured stress is within
  // .002.
  static void expect_follows(const std::string& wood, const press::Outcome<2>& outcome,
                             const std::function<double(double)>& closed) {
    double worst_stress = 0, worst_shift = 0, before = 0;
    for (const auto& r : outcome.records) {
      const double C = 0.5 * (before + r.compaction);  // middle of the record's interval
      before = r.compaction;
      if (C >= 0.1) {
        worst_stress = std::max(worst_stress, std::abs(r.stress_MPa / closed(C) - 1));
        continue;
      }
      double low = 0, high = 0.2;
      for (int i = 0; i < 60; ++i) (closed(0.5 * (low + high)) < r.stress_MPa ? low : high) = 0.5 * (low + high);
      worst_shift = std::max(worst_shift, std::abs(low - C));
    }
    EXPECT_LT(worst_stress, 0.02);
    EXPECT_LT(worst_shift, 0.002);
    const std::string what = wood + " stack, " + testing::PrintToString(GetParam()) + ": ";
    report(what + "largest error of the stress, C >= 0.1", worst_stress, "< 0.02");
    report(what + "largest shift of the curve, C < 0.1", worst_shift, "< 0.002");
    EXPECT_GT(outcome.records.size(), 190u);
  }
};

TEST_P(Stack, ElasticFollowsTheClosedForm) {
  const ConfinedStrand confined(poplar(false));
  expect_follows("elastic", run(false), [&](double C) { return confined.elastic(C); });
}

TEST_P(Stack, HillFollowsTheClosedForm) {
  const ConfinedStrand confined(poplar(true));
  expect_follows("Hill", run(true), [&](double C) { return confined.hill(C); });
}

INSTANTIATE_TEST_SUITE_P(Press, Stack,
                         testing::Values(Case{0, false}, Case{0.25, false}, Case{0.37, false}, Case{0.5, false},
                                         Case{0, true}, Case{0.25, true}, Case{0.37, true}, Case{0.5, true}));

}  // namespace
}  // namespace strandlab::press_tests
