// Stacks whose rows differ in thickness and material: rows in series carry one stress, and their compactions add up by
// thickness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "support/report.hpp"
#include "verification/press/stacks.hpp"

namespace strandlab::press_tests {
namespace {

struct Row {
  const char* kind;
  double thickness_mm;
};

std::vector<StrandKind> kinds() {
  return {{"normal", wood::library()[0], 0}, {"dense", wood::library()[1], 0}};
}

// Rows of 0.8, 1.1 and 1.3 mm: 6, 8 and 10 points through, none of the faces but one on a grid line.
const std::vector<Row>& rows() {
  static const std::vector<Row> list{{"normal", 0.8}, {"dense", 1.1}, {"normal", 1.3}};
  return list;
}

Panel<2> stack(const std::vector<Row>& plies, const std::vector<StrandKind>& of) {
  mat::Mat mat;
  mat.length_mm = 1.6;
  mat.layer_thickness_mm = 0.8;
  for (const auto& row : plies)
    mat.layers.push_back({row.kind, {{0, mat.length_mm, {}, {}, {}}}, {}, row.thickness_mm});
  return make_panel(mat, of, 0.8 / 6, 6);
}

press::Outcome<2> run(const Panel<2>& panel, double compaction, press::Sink<2> sink = {}) {
  mpm::Options options;
  options.friction = options.platen_friction = 0;
  press::Schedule schedule;
  schedule.speed_m_s = 4;
  schedule.ramp_time_fraction = 0.1;
  schedule.symmetric = true;
  schedule.compactions = {compaction};
  schedule.record_interval_compaction = 0.002;
  return press::press<2>(panel, schedule, press::setup(panel, {}, mpm::Side::kRoller, options), sink);
}

double bisect(double low, double high, const std::function<bool(double)>& too_low) {
  for (int i = 0; i < 50; ++i) (too_low(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return low;
}

// Stress of the stack at compaction C: all rows confined, each compacted until it carries the same. Tabulated over the
// compaction of the normal rows and interpolated.
class Series {
 public:
  Series() {
    const ConfinedStrand normal(wood::library()[0]), dense(wood::library()[1]);
    for (int i = 0; i <= 600; ++i) {
      const double c = 1e-3 * i, stress = normal.hill(c);
      const double other = bisect(0, 0.9, [&](double trial) { return dense.hill(trial) < stress; });
      double closed = 0, whole = 0;
      for (const auto& row : rows()) {
        closed += row.thickness_mm * (row.kind == std::string("dense") ? other : c);
        whole += row.thickness_mm;
      }
      compaction_.push_back(closed / whole);
      stress_.push_back(stress);
    }
  }
  double stress(double C) const {
    const auto above = std::upper_bound(compaction_.begin() + 1, compaction_.end() - 1, C) - compaction_.begin();
    const auto i = static_cast<std::size_t>(above);
    const double part = (C - compaction_[i - 1]) / (compaction_[i] - compaction_[i - 1]);
    return stress_[i - 1] + part * (stress_[i] - stress_[i - 1]);
  }

 private:
  std::vector<double> compaction_, stress_;
};

// Within 2 % of the closed form from a tenth on, as stacks of equal rows are; the platens start at the true faces.
TEST(Thickness, StackOfUnequalRowsFollowsTheClosedForm) {
  const auto panel = stack(rows(), kinds());
  EXPECT_DOUBLE_EQ(panel.top_mm, 3.2);
  const auto outcome = run(panel, 0.3);
  const Series series;
  double worst = 0, before = 0;
  for (const auto& r : outcome.records) {
    const double C = 0.5 * (before + r.compaction);
    before = r.compaction;
    if (C >= 0.1) worst = std::max(worst, std::abs(r.stress_MPa / series.stress(C) - 1));
  }
  ASSERT_GT(outcome.records.size(), 140U);
  report("stack of rows of .8, 1.1 (VTC) and 1.3 mm, stress from C = .1 on against the closed form", worst,
         below(0.02));
}

// Platens that close from both sides see the mirrored stack as the stack itself upside down.
TEST(Thickness, MirroredStackPressesAlike) {
  auto mirrored = rows();
  std::reverse(mirrored.begin(), mirrored.end());
  const auto a = run(stack(rows(), kinds()), 0.2), b = run(stack(mirrored, kinds()), 0.2);
  ASSERT_EQ(a.records.size(), b.records.size());
  double worst = 0;
  for (std::size_t i = a.records.size() / 4; i < a.records.size(); ++i)
    worst = std::max(worst, std::abs(a.records[i].stress_MPa / b.records[i].stress_MPa - 1));
  report("stress of the stack upside down, both platens moving, difference", worst,
         below(1e-11).because(test::kRoundOff));
}

// With every constant of stress softened by one factor, the same motion takes that much less stress. At half the
// density, elastic waves run as before too, so that every record agrees to round-off.
TEST(Softening, ScalesThePressingCurveExactly) {
  auto light = kinds();
  auto soft = kinds();
  for (auto& kind : light) kind.material.density_kg_m3 *= 0.5;
  for (auto& kind : light) kind.yield_factor = kind.stiffness_factor = 0.5;
  const auto a = run(stack(rows(), soft), 0.2), b = run(stack(rows(), light), 0.2);
  ASSERT_EQ(a.records.size(), b.records.size());
  double worst = 0;
  for (std::size_t i = 1; i < a.records.size(); ++i)
    worst = std::max(worst, std::abs(b.records[i].stress_MPa - 0.5 * a.records[i].stress_MPa));
  report("stress of a stack softened to half, difference from half the stress", worst,
         below(1e-8).because(test::kRoundOff), "MPa");
}

// A softer row gives way first: softened to half, it is compacted more than the same row in a stack of equals.
TEST(Softening, SoftenedRowsAreCompactedMore) {
  auto of = kinds();
  of[0].stiffness_factor = 0.5;
  of[0].yield_factor = 0.5;
  of[1].material = of[0].material;
  const auto thickness = [&](const std::vector<StrandKind>& kinds_of) {
    double first = 0;
    press::Sink<2> sink;
    sink.snapshot = [&](const Panel<2>& state, int) {
      const auto& s = state.strands[0];
      double sum = 0;
      for (const auto& F : s.points.F) sum += F(1, 1);
      first = sum / static_cast<double>(s.size());
    };
    run(stack({{"normal", 0.8}, {"dense", 1.2}}, kinds_of), 0.2, sink);
    return first;
  };
  auto equal = of;
  equal[0].stiffness_factor = equal[0].yield_factor = 1;
  EXPECT_NEAR(thickness(equal), 0.8, 0.005);
  EXPECT_LT(thickness(of), 0.77);
}

}  // namespace
}  // namespace strandlab::press_tests
