// Strands that lie turned against the grid: their lattice starts with F = R and must press as one that lies along it.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "support/report.hpp"
#include "verification/press/planks.hpp"

namespace strandlab::press_tests {
namespace {

constexpr double kWindow = 40;  // mm, far beyond the strands

struct PressedPlanks {
  std::vector<press::Record> records;
  Panel<3> panel;
};

PressedPlanks press_free(const std::vector<Plank>& planks, bool yields, double compaction, double aspect = 3) {
  const auto panel = panel_of(planks, Vec<2>(kWindow, kWindow), 0.5 * aspect * kLayer / 3, yields);
  press::Resolution resolution;
  resolution.cell_aspect = aspect;
  mpm::Options options;
  options.platen_friction = 0;
  press::Schedule schedule;
  schedule.speed_m_s = 8;
  schedule.ramp_time_fraction = 0.2;
  schedule.compactions = {compaction};
  schedule.record_interval_compaction = 0.002;
  PressedPlanks pressed;
  press::Sink<3> sink;
  sink.snapshot = [&](const Panel<3>& then, int) { pressed.panel = then; };
  const auto setup = press::setup(panel, resolution, mpm::Side::kFree, options);
  pressed.records = press::press<3>(panel, schedule, setup, sink).records;
  return pressed;
}

// One strand between smooth platens, elastic: the stress of an independent run of the same method (101.93, 101.92 and
// 101.91 MPa at 0, 17 and 45 degrees).
TEST(TurnedStrand, PressesAlikeAtAnyAngle) {
  constexpr double kLong = 12, kWide = 6, kAbout = 0.05;
  double straight = 0;
  for (const double angle : {0.0, 17.0, 45.0}) {
    const auto outcome = press_free({{0, 20, 20, kLong, kWide, angle}}, false, 0.06);
    const double stress = stress_about(outcome.records, kAbout, 0.01) * kWindow * kWindow / (kLong * kWide);
    if (angle == 0) straight = stress;
    if (angle > 0)
      report("one strand turned by " + std::to_string(static_cast<int>(angle)) +
                 " degrees, stress at C = 0.05 over "
                 "that of one along the grid",
             stress / straight, near(1, 0.005));
  }
  // Free to widen: between uniaxial stress, E_R ln, and uniaxial strain.
  EXPECT_GT(straight, poplar(false).E_R * 0.05);
  EXPECT_LT(straight, ConfinedStrand(poplar(false)).elastic(0.05));
}

// Two strands across each other, turned as a whole (an independent run of the same method, 24 mm long strands,
// found 35.4 and 36.0 MPa at 0 and 45 degrees).
TEST(TurnedStrand, CrossedPairsPressAlikeAtAnyAngle) {
  constexpr double kAbout = 0.09;
  std::vector<double> stress;
  for (const double turn : {0.0, 45.0}) {
    const auto outcome = press_free({{0, 20, 20, 16, 6, turn}, {1, 20, 20, 16, 6, turn + 90}}, true, 0.1);
    stress.push_back(stress_about(outcome.records, kAbout, 0.01));
  }
  report("crossed pair turned by 45 degrees, stress at C = 0.09 over that along the grid", stress[1] / stress[0],
         near(1, 0.03));
}

// A corner .2 mm from the long edge of another strand of the layer: it presses as 6 mm away, and neither leaves the
// layer's height.
TEST(TurnedStrand, LeavesItsNeighbourInTheLayerAlone) {
  constexpr double kReach = 6.364;  // mm, from the middle of a strand turned by 45 degrees to its lowest corner
  const auto press_apart = [](double gap) {
    return press_free({{0, 20, 12, 12, 6, 0}, {0, 20, 15 + gap + kReach, 12, 6, 45}}, false, 0.06);
  };
  const auto close = press_apart(0.2), apart = press_apart(6);
  report("strand with its corner .2 mm from another's edge, stress at C = 0.05 over that 6 mm apart",
         stress_about(close.records, 0.05, 0.01) / stress_about(apart.records, 0.05, 0.01), near(1, 1e-4));
  double worst = 0;
  for (const auto& strand : close.panel.strands) {
    double height = 0;
    for (const auto& x : strand.points.x) height += x[2] / static_cast<double>(strand.size());
    worst = std::max(worst, std::abs(height / close.panel.top_mm - 0.5));
  }
  report("the two strands, mean height off the middle of the layer over its thickness", worst, below(5e-4));
}

std::vector<mpm::Body<3>> body_at(double angle_deg) {
  const auto panel = panel_of({{0, 20, 20, 8, 4, angle_deg}}, Vec<2>(kWindow, kWindow), 0.4, false);
  return {mpm::body_of(panel.strands.front())};
}

mpm::Grid<3> grid_without_platens() {
  mpm::Grid<3> grid;
  grid.cell = {0.8, 0.8, kLayer / 3};
  grid.origin = grid.lo = Vec<3>::Zero();
  grid.hi = {kWindow, kWindow, 10};
  return grid;
}

TEST(TurnedStrand, HasNoStressInFlight) {
  auto bodies = body_at(17);
  for (auto& v : bodies[0].points.v) v = Vec<3>(2e4, -1e4, 3e3);
  mpm::Engine<3> engine(bodies, grid_without_platens(), mpm::Options{});
  for (int i = 0; i < 100; ++i) engine.step();
  engine.write(bodies);
  double largest = 0;
  for (const auto& s : bodies[0].points.stress) largest = std::max(largest, s.cwiseAbs().maxCoeff());
  report("strand turned by 17 degrees in free flight, largest stress after 100 steps", largest,
         below(1e-12).because(test::kRoundOff), "MPa");
}

// Stretched along its grain while it narrows as wood in tension does: stress E_L e along, none else.
TEST(TurnedStrand, HasItsModulusAlongItsGrain) {
  constexpr double kAngle = 17, kStrain = 1e-4, kStep = 1e-8;
  auto bodies = body_at(kAngle);
  mpm::Engine<3> engine(bodies, grid_without_platens(), mpm::Options{});
  const auto m = poplar(false);
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(kAngle * std::numbers::pi / 180, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  // Strand axes: along L, across T, thickness R.
  const Eigen::Vector3d strain(1, -m.nu_TL * m.E_L / m.E_T, -m.nu_RL * m.E_L / m.E_R);
  const Eigen::Matrix3d rate = kStrain / (10 * kStep) * R * strain.asDiagonal() * R.transpose();
  for (int i = 0; i < 10; ++i) engine.impose(kStep, [&](const Vec<3>& x) -> Vec<3> { return rate * x; });
  engine.write(bodies);
  double worst = 0, worst_across = 0;
  for (const auto& s : bodies[0].points.stress) {
    worst = std::max(worst, std::abs(s[0] / (m.E_L * kStrain) - 1));
    worst_across = std::max(worst_across, std::max(std::abs(s[1]), std::abs(s[2])) / (m.E_L * kStrain));
  }
  report("strand turned by 17 degrees in tension along its grain, stress over E_L e", 1 + worst,
         near(1, 1e-12).because(test::kRoundOff));
  report("strand turned by 17 degrees in tension along its grain, largest stress across over E_L e", worst_across,
         below(1e-12).because(test::kRoundOff));
}

}  // namespace
}  // namespace strandlab::press_tests
