// The engine in three dimensions against its section, and a morphology that has no section: crossed strands.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "support/report.hpp"
#include "verification/press/stacks.hpp"

namespace strandlab::press_tests {
namespace {

constexpr double kCell = 0.8 / 3;  // mm
constexpr int kAcross = 4;         // cells
constexpr int kPointsAcross = 2 * kAcross;

// A small mat with gaps, so that strands bend and ends meet: rows of strands 8 points long (the lattices of the section
// and of the extrusion then meet the same limit on the time step). Cells 0..20 along; the middle row is a core row.
struct Piece {
  int row;
  double from, angle_deg;  // cells
};
const std::vector<Piece>& pieces() {
  static const std::vector<Piece> list{{0, 0, 0},    {0, 5, 0},   {0, 10, 0},  {0, 15.5, 0}, {1, 2, 90},
                                       {1, 7.3, 90}, {1, 12, 90}, {2, 0.5, 0}, {2, 6, 0},    {2, 13, 0}};
  return list;
}

template <int Dim>
Panel<Dim> mat() {
  constexpr double kRow = 0.8;
  Panel<Dim> panel;
  panel.length_mm = 20 * kCell;
  panel.depth_mm = Dim == 2 ? 1 : kAcross * 1.5 * kCell;
  panel.initial_thickness_mm = panel.top_mm = 3 * kRow;
  for (const auto& p : pieces()) {
    Vec<Dim> low = Vec<Dim>::Zero(), high = Vec<Dim>::Constant(panel.depth_mm);
    std::array<int, Dim> points{};
    points.fill(kPointsAcross);
    low[0] = p.from * kCell;
    high[0] = low[0] + 4 * kCell;
    points[0] = 8;
    low[Dim - 1] = p.row * kRow;
    high[Dim - 1] = (p.row + 1) * kRow;
    points[Dim - 1] = 6;
    panel.strands.push_back(strand<Dim>(poplar(true), p.angle_deg, p.row, low, high, points));
  }
  return panel;
}

// Cells 1.5 times as wide across: then the section's directions alone set the time step, and both runs take the same
// steps. Their height follows the platens, as the section's.
template <int Dim>
press::Setup<Dim> setup_of(const Panel<Dim>& panel) {
  auto setup = press::setup(panel, press::Resolution{}, mpm::Side::kRoller, mpm::Options{});
  if (Dim == 3) setup.grid.cell[1] = 1.5 * kCell;
  setup.grid.follow = mpm::Follow::kPlatens;
  return setup;
}

template <int Dim>
struct PressedBox {
  std::vector<mpm::Body<Dim>> bodies;
  std::vector<double> top_force;  // N per mm of depth, per step
  mpm::Energies energies;
};

template <int Dim>
PressedBox<Dim> press_steps(int steps) {
  const Panel<Dim> panel = mat<Dim>();
  PressedBox<Dim> result;
  for (const auto& s : panel.strands) result.bodies.push_back(mpm::body_of(s));
  const auto setup = setup_of(panel);
  mpm::Engine<Dim> engine(result.bodies, setup.grid, setup.engine);
  engine.set_platens({0, 0}, {panel.top_mm, -16000});
  for (int i = 0; i < steps; ++i) {
    engine.step();
    result.top_force.push_back(engine.top_force() / (Dim == 3 ? panel.depth_mm : 1.0));
  }
  engine.write(result.bodies);
  result.energies = engine.energies();
  return result;
}

// Rollers across make a prism deform in plane strain: every particle of the extrusion moves as the one of the section,
// and not across; platen force and energies per depth agree.
TEST(ThreeDimensions, ExtrudedMatMovesAsItsSection) {
  const auto section = press_steps<2>(200);
  const auto prism = press_steps<3>(200);
  double worst = 0, across = 0, moved = 0;
  for (std::size_t b = 0; b < section.bodies.size(); ++b) {
    const auto& s = section.bodies[b];
    const auto& p = prism.bodies[b];
    for (std::size_t i = 0; i < p.points.size(); ++i) {
      const std::size_t column = i % 8, layer = i / (8 * kPointsAcross), j = i / 8 % kPointsAcross;
      const auto& x = s.points.x[column + 8 * layer];
      worst = std::max(worst, std::hypot(p.points.x[i][0] - x[0], p.points.x[i][2] - x[1]));
      across = std::max(across, std::abs(p.points.x[i][1] - (static_cast<double>(j) + 0.5) * p.lattice.spacing[1]));
      moved = std::max(moved, std::abs(x[1] - (pieces()[b].row * 0.8 + (static_cast<double>(layer) + 0.5) * 0.8 / 6)));
    }
  }
  EXPECT_GT(moved, 0.05);  // mm; something happened
  report("extruded mat against its section, positions after 200 steps", worst, below(1e-12).because(test::kRoundOff),
         "mm");
  report("extruded mat: largest motion across after 200 steps", across, below(1e-12).because(test::kRoundOff), "mm");
  for (std::size_t i = 0; i < section.top_force.size(); ++i) {
    EXPECT_NEAR(prism.top_force[i], section.top_force[i], 1e-7 + 1e-7 * std::abs(section.top_force[i])) << "step " << i;
  }
  const double depth = kAcross * 1.5 * kCell;
  EXPECT_NEAR(prism.energies.plastic / depth, section.energies.plastic, 1e-8 * section.energies.plastic);
  EXPECT_NEAR(prism.energies.elastic / depth, section.energies.elastic, 1e-8 * section.energies.elastic);
  EXPECT_NEAR(prism.energies.platen_work / depth, section.energies.platen_work, 1e-8 * section.energies.platen_work);
}

template <int Dim>
std::vector<press::Record> press_to(double compaction) {
  const Panel<Dim> panel = mat<Dim>();
  press::Schedule schedule;
  schedule.compactions = {0, compaction};
  schedule.record_interval_compaction = 0.005;
  return press::press<Dim>(panel, schedule, setup_of(panel), {}).records;
}

// The pressing curve to C = .1; stresses below 0.5 MPa are compared in MPa.
TEST(ThreeDimensions, ExtrudedMatHasThePressingCurveOfItsSection) {
  const auto section = press_to<2>(0.1), prism = press_to<3>(0.1);
  ASSERT_EQ(section.size(), prism.size());
  double worst = 0;
  for (std::size_t i = 0; i < section.size(); ++i) {
    worst =
        std::max(worst, std::abs(prism[i].stress_MPa - section[i].stress_MPa) / std::max(0.5, section[i].stress_MPa));
  }
  EXPECT_GT(section.back().stress_MPa, 1);
  report("extruded mat against its section, pressing curve to C = 0.1", worst, below(1e-10).because(test::kRoundOff));
}

// Two strands 4 mm long and 1.6 mm wide across each other, pressed by 15 % between smooth platens. Each is alone at its
// arms, both carry the square in the middle.
class CrossedStrands : public testing::Test {
 protected:
  static constexpr double kLength = 4, kWidth = 1.6, kThick = 0.8, kSize = 8;
  CrossedStrands() {
    const Vec<3> middle(0.5 * kSize, 0.5 * kSize, 0);
    // The upper one is turned in the plane by turning its wood: its lattice lies along y.
    strands_.push_back(strand<3>(poplar(true), 0, 0, middle - Vec<3>(kLength / 2, kWidth / 2, 0),
                                 middle + Vec<3>(kLength / 2, kWidth / 2, kThick), {30, 12, 6}));
    strands_.push_back(strand<3>(poplar(true), 90, 1, middle - Vec<3>(kWidth / 2, kLength / 2, -kThick),
                                 middle + Vec<3>(kWidth / 2, kLength / 2, 2 * kThick), {12, 30, 6}));
    for (const auto& s : strands_) bodies_.push_back(mpm::body_of(s));
    mpm::Grid<3> grid;
    grid.cell = Vec<3>::Constant(kThick / 3);
    grid.origin = Vec<3>::Zero();
    grid.lo = Vec<3>::Zero();
    grid.hi = Vec<3>(kSize, kSize, 2 * kThick);
    mpm::Options options;
    options.platen_friction = 0;
    engine_.emplace(bodies_, grid, options);
    engine_->set_platens({0, 0}, {2 * kThick, 0});
  }
  std::vector<Strand<3>> strands_;
  std::vector<mpm::Body<3>> bodies_;
  std::optional<mpm::Engine<3>> engine_;
};

TEST_F(CrossedStrands, KeepTheirMomentumAndDoNotInterpenetrate) {
  const double mass = engine_->mass();
  double impulse = 0, pushed = 0, plastic = 0;
  while (engine_->state().top.position > 0.85 * 2 * kThick) {
    engine_->set_platen_velocities(0, -16000 * std::min(1.0, 0.05 + engine_->state().time_s / 4e-6));
    engine_->step();
    const double dt = engine_->state().time_step_s;
    impulse += (engine_->bottom_force() - engine_->top_force()) * dt;
    pushed += (engine_->bottom_force() + engine_->top_force()) * dt;
    const Vec<3> p = engine_->momentum();
    ASSERT_NEAR(p[2], impulse, 1e-11 * pushed);
    ASSERT_LT(std::hypot(p[0], p[1]), 1e-11 * pushed);
    ASSERT_GE(engine_->state().energies.plastic, plastic);
    plastic = engine_->state().energies.plastic;
  }
  EXPECT_EQ(engine_->mass(), mass);
  EXPECT_GT(plastic, 0);
  engine_->write(bodies_);
  // Height of the interface: every surface point of the upper strand's bottom against the nearest one of the lower
  // strand's top.
  double sum = 0, worst = 0;
  int count = 0;
  const auto point = [](const mpm::Body<3>& b, const mpm::Face<3>& f, std::size_t i) -> Vec<3> {
    return b.points.x[f.particle[i]] + b.points.F[f.particle[i]] * f.offset[i];
  };
  const auto &top = bodies_[0].faces[1], &bottom = bodies_[1].faces[0];
  for (std::size_t i = 0; i < bottom.particle.size(); ++i) {
    const Vec<3> a = point(bodies_[1], bottom, i);
    if (std::abs(a[1] - 0.5 * kSize) > kWidth / 2) continue;
    double nearest = 1e300, gap = 0;
    for (std::size_t k = 0; k < top.particle.size(); ++k) {
      const Vec<3> b = point(bodies_[0], top, k);
      const double d = (a - b).head<2>().norm();
      if (d >= nearest) continue;
      nearest = d;
      gap = (a - b)[2] / (kThick / 3);
    }
    sum += gap;
    worst = std::min(worst, gap);
    ++count;
  }
  ASSERT_GT(count, 100);
  report("crossed strands pressed by 15 %: mean gap of their interface", sum / count, within(2e-3), "cells");
  // At the strands' edges, where the arms bend away.
  report("crossed strands pressed by 15 %: deepest overlap, at the edges", -worst, below(0.03), "cells");
}

}  // namespace
}  // namespace strandlab::press_tests
