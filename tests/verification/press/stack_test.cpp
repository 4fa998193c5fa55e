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

press::Outcome<2> press_slowly(const Panel<2>& panel, double compaction, int cells_through_strand = 3) {
  mpm::Options options;
  options.friction = options.platen_friction = 0;
  press::Resolution resolution;
  resolution.cell_aspect = 2;
  resolution.cells_through_strand = cells_through_strand;
  press::Schedule schedule;
  schedule.speed_m_s = 1;
  schedule.ramp_time_fraction = 0.1;
  schedule.compactions = {0, compaction};
  schedule.record_interval_compaction = 0.004;
  return press::press<2>(panel, schedule, press::setup(panel, resolution, mpm::Side::kRoller, options), {});
}

// Stress at a compaction: a record holds the mean over the interval since the one before, whose middle is its place.
double stress_at(const std::vector<press::Record>& records, double compaction) {
  double C0 = 0, C = 0, s0 = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    C = 0.5 * ((i > 0 ? records[i - 1].compaction : 0) + records[i].compaction);
    if (C >= compaction) return s0 + (records[i].stress_MPa - s0) * (compaction - C0) / (C - C0);
    C0 = C;
    s0 = records[i].stress_MPa;
  }
  ADD_FAILURE() << "pressed to " << C << " only";
  return 0;
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

  // From C = .1 on the stress; below, the compaction at which the closed form has the measured stress.
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
    const std::string what = wood + " stack, " + testing::PrintToString(GetParam()) + ": ";
    report(what + "largest error of the stress, C >= 0.1", worst_stress,
           below(GetParam().follow                 ? 5e-4
                 : GetParam().offset_cells == 0.25 ? 1e-3
                 : wood == "elastic"               ? 4e-3
                                                   : 2e-3));
    report(what + "largest shift of the curve, C < 0.1", worst_shift, below(1e-3));
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

// Stress of a confined strand that crushes by compaction, MPa, integrated independently.
const std::vector<std::pair<double, double>> kCrushed{{.1, 3.29}, {.2, 3.70}, {.3, 4.31},
                                                      {.4, 5.30}, {.5, 7.16}, {.6, 11.82}};

// Rows by these laws of yielding, along and across in turn (both are confined alike).
Panel<2> rows_of(const std::vector<wood::Law>& laws, int cells_through_strand = 3) {
  constexpr int kColumns = 6;
  constexpr double kRow = 0.8;
  const double cell = 2 * kRow / cells_through_strand;
  Panel<2> panel;
  panel.length_mm = kColumns * cell;
  panel.initial_thickness_mm = panel.top_mm = kRow * static_cast<double>(laws.size());
  for (int row = 0; row < static_cast<int>(laws.size()); ++row) {
    auto wood = poplar(true);
    wood.law = laws[static_cast<std::size_t>(row)];
    panel.strands.push_back(strand<2>(wood, row % 2 ? 90 : 0, row, Vec<2>(0, row * kRow),
                                      Vec<2>(panel.length_mm, (row + 1) * kRow),
                                      {2 * kColumns, 2 * cells_through_strand}));
  }
  return panel;
}

// Pressed to 60 % between rollers. Wood this soft carries slow plastic waves, hence the slow platen.
TEST(CrushingStack, FollowsTheConfinedCheckValues) {
  const auto crushing = wood::Law::kCrushing;
  const auto panel = rows_of({crushing, crushing, crushing, crushing});
  const auto outcome = press_slowly(panel, 0.62);
  double worst = 0, plastic = 0, unbalanced = 0;
  for (const auto& [C, stress] : kCrushed) {
    const double measured = stress_at(outcome.records, C);
    worst = std::max(worst, std::abs(measured / stress - 1));
  }
  for (const auto& r : outcome.records) {
    EXPECT_GE(r.plastic_mJ, plastic) << "C = " << r.compaction;
    plastic = r.plastic_mJ;
    if (r.compaction < 0.01) continue;
    unbalanced = std::max(unbalanced, std::abs(r.balance_error()));
  }
  report("stack of strands that crush, confined, to 60 %: largest deviation of stress from the check values", worst,
         below(0.003));
  report("the same stack: worst energy balance over the platens' work", unbalanced, below(3e-5));
}

// Rows by either law in one stack carry the same stress: those that crush take all of the compaction but what the
// others take by their own law, below two per cent. The velocity of a row is not linear through it as in a stack of
// equals, and a row crushed to half has 2 cells left through it: finer cells are nearer.
TEST(CrushingStack, CarriesTheStressOfItsHillRows) {
  const auto crushing = wood::Law::kCrushing, hill = wood::Law::kHill;
  const ConfinedStrand confined(poplar(true));
  for (const auto& [cells, limit] : {std::pair{3, 0.1}, std::pair{6, 0.06}, std::pair{12, 0.02}}) {
    const auto outcome = press_slowly(rows_of({crushing, hill, hill, crushing}, cells), 0.26, cells);
    double worst = 0;
    for (const auto& [crushed, stress] : kCrushed) {
      if (crushed > 0.5) continue;
      double low = 0, high = 0.1;
      for (int i = 0; i < 50; ++i) (confined.hill(0.5 * (low + high)) < stress ? low : high) = 0.5 * (low + high);
      ASSERT_LT(high, 0.02);
      const double measured = stress_at(outcome.records, 0.5 * (crushed + low));
      worst = std::max(worst, std::abs(measured / stress - 1));
    }
    report("rows that crush to 50 % beside rows by Hill's law, " + std::to_string(cells) +
               " cells through a strand: largest deviation of stress from the check values",
           worst, below(limit));
  }
}

INSTANTIATE_TEST_SUITE_P(Press, Stack,
                         testing::Values(Case{0, false}, Case{0.25, false}, Case{0.37, false}, Case{0.5, false},
                                         Case{0, true}, Case{0.25, true}, Case{0.37, true}, Case{0.5, true}));

}  // namespace
}  // namespace strandlab::press_tests
