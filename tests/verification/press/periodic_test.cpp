// A window that repeats: strands go on beyond its edge and meet the images of others, and their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/mpm/kernels.hpp"
#include "support/near.hpp"
#include "support/report.hpp"
#include "verification/press/planks.hpp"

namespace strandlab::press_tests {
namespace {

constexpr double kCellAspect = 3, kCellLength = kCellAspect * kLayer / 3;  // mm
const Vec<2> kTorus(12, 12);

template <int Dim>
mpm::Grid<Dim> torus_grid(const Panel<Dim>& panel) {
  press::Resolution resolution;
  resolution.cell_aspect = kCellAspect;
  return press::setup(panel, resolution, mpm::Side::kPeriodic, mpm::Options{}).grid;
}

mpm::Options smooth() {
  mpm::Options options;
  options.platen_friction = 0;
  return options;
}

struct Steps {
  std::vector<double> force;  // N, on the top platen, per step
  double pushed = 0;          // N s, impulses of both platens
  double drift = 0;           // t mm/s, momentum in the plane after the last step
};

template <int Dim>
Steps take_steps(const Panel<Dim>& panel, const mpm::Grid<Dim>& grid, int steps) {
  std::vector<mpm::Body<Dim>> bodies;
  for (const auto& s : panel.strands) bodies.push_back(mpm::body_of(s));
  mpm::Engine<Dim> engine(bodies, grid, smooth());
  engine.set_platens({0, 0}, {panel.top_mm, -16000});
  Steps result;
  for (int i = 0; i < steps; ++i) {
    engine.step();
    result.force.push_back(engine.top_force());
    result.pushed += (engine.top_force() + engine.bottom_force()) * engine.state().time_step_s;
  }
  result.drift = engine.momentum().template head<Dim - 1>().norm();
  return result;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = std::max(difference, std::abs(a[i] - b[i]));
    largest = std::max(largest, std::abs(a[i]));
  }
  return difference / largest;
}

std::vector<Plank> shifted(std::vector<Plank> planks, double dx, double dy) {
  for (auto& p : planks) {
    p.cx += dx;
    p.cy += dy;
  }
  return planks;
}

TEST(PeriodicWindow, HasNoEdges) {
  const auto first = panel_of(turned_planks(), kTorus, kCellLength / 2);
  auto planks = shifted(turned_planks(), 4 * kCellLength, -3 * kCellLength);
  planks[0].cx += kTorus[0];  // whole periods away from the others
  planks[4].cy -= kTorus[1];
  const auto moved = panel_of(planks, kTorus, kCellLength / 2);
  const auto a = take_steps(first, torus_grid(first), 100), b = take_steps(moved, torus_grid(moved), 100);
  report("torus mat moved by whole cells and single strands by whole periods, platen force over 100 steps",
         largest_difference(a.force, b.force), below(1e-9).because(test::kRoundOff));
  report("torus mat, momentum in its plane over the platens' impulses after 100 steps", a.drift / a.pushed,
         below(1e-12).because(test::kRoundOff));
}

press::Outcome<3> press_torus(const Panel<3>& panel, double compaction) {
  press::Resolution resolution;
  resolution.cell_aspect = kCellAspect;
  press::Schedule schedule;
  schedule.compactions = {compaction};
  schedule.record_interval_compaction = 0.005;
  return press::press<3>(panel, schedule, press::setup(panel, resolution, mpm::Side::kPeriodic, smooth()), {});
}

TEST(PeriodicWindow, HasNoPlaceOfItsOwn) {
  const auto stress = [](const std::vector<Plank>& planks) {
    return stress_about(press_torus(panel_of(planks, kTorus, kCellLength / 2), 0.25).records, 0.22, 0.03);
  };
  report("torus mat moved by a part of a cell, stress at C = 0.22",
         stress(shifted(turned_planks(), 0.37, 0.21)) / stress(turned_planks()), near(1, 0.02));
}

// .2 mm from its own image a strand is free; as long as the window it is confined.
TEST(PeriodicWindow, StrandsMeetTheirOwnImages) {
  const auto run = [](double length, mpm::Side sides) {
    const auto panel = panel_of({{0, 5, 6, length, 4, 0}}, kTorus, kCellLength / 2, false);
    auto grid = torus_grid(panel);
    for (int a = 0; a < 2; ++a) grid.sides[static_cast<std::size_t>(a)] = {sides, sides};
    return take_steps(panel, grid, 300).force;
  };
  report("strand .2 mm from its own image, platen force against one on a window without images",
         largest_difference(run(11.8, mpm::Side::kPeriodic), run(11.8, mpm::Side::kFree)),
         below(1e-12).because(test::kRoundOff));
  EXPECT_GT(largest_difference(run(12, mpm::Side::kPeriodic), run(12, mpm::Side::kFree)), 1e-3);
}

// As long as the window it is confined as between rollers: 2.3 % stiffer than free, the widening along the grain is
// small.
TEST(PeriodicWindow, ConfinesASectionOfItsLength) {
  const auto stress = [](mpm::Side sides, double from) {
    Panel<2> panel;
    panel.length_mm = 16;
    panel.initial_thickness_mm = panel.top_mm = kLayer;
    panel.strands.push_back(strand<2>(poplar(false), 0, 0, Vec<2>(from, 0), Vec<2>(from + 16, kLayer), {40, 6}));
    press::Resolution resolution;
    resolution.cell_aspect = kCellAspect;
    press::Schedule schedule;
    schedule.speed_m_s = 2;
    schedule.compactions = {0.12};
    schedule.record_interval_compaction = 0.002;
    const auto outcome = press::press<2>(panel, schedule, press::setup(panel, resolution, sides, smooth()), {});
    return stress_about(outcome.records, 0.1, 0.01);
  };
  const double confined = stress(mpm::Side::kRoller, 0);
  EXPECT_LT(stress(mpm::Side::kFree, 3), 0.985 * confined);
  report("strand as long as a periodic window, stress at C = 0.1 over that between rollers",
         stress(mpm::Side::kPeriodic, 3) / confined, near(1, 0.005));
}

// A mirror-symmetric mat on a torus is its half between rollers.
TEST(PeriodicWindow, OfAMirrorSymmetricMatIsAPairOfRollers) {
  struct Piece {
    int row;
    double from, to;
  };
  const auto panel = [](double length, const std::vector<Piece>& pieces) {
    Panel<2> p;
    p.length_mm = length;
    p.initial_thickness_mm = p.top_mm = 3 * kLayer;
    for (const auto& piece : pieces) {
      p.strands.push_back(strand<2>(poplar(true), 0, piece.row, Vec<2>(piece.from, piece.row * kLayer),
                                    Vec<2>(piece.to, (piece.row + 1) * kLayer),
                                    {static_cast<int>(std::lround(2 * (piece.to - piece.from) / kCellLength)), 6}));
    }
    return p;
  };
  const auto half = panel(8, {{0, 0, 3.2}, {0, 4, 8}, {1, 1.2, 6.4}, {2, 0, 5.2}, {2, 6, 8}});
  const auto torus = panel(16, {{0, -3.2, 3.2}, {0, 4, 12}, {1, 1.2, 6.4}, {1, 9.6, 14.8}, {2, -5.2, 5.2}, {2, 6, 10}});
  const auto stress = [](const Panel<2>& mat, mpm::Side sides) {
    press::Resolution resolution;
    resolution.cell_aspect = kCellAspect;
    press::Schedule schedule;
    schedule.compactions = {0.2};
    schedule.record_interval_compaction = 0.005;
    const auto outcome = press::press<2>(mat, schedule, press::setup(mat, resolution, sides, smooth()), {});
    return stress_about(outcome.records, 0.15, 0.05);
  };
  report("mirror-symmetric torus over its half between rollers, stress at C = 0.15",
         stress(torus, mpm::Side::kPeriodic) / stress(half, mpm::Side::kRoller), near(1, 0.003));
}

// Strands across the whole window between rollers are in plane strain, as in a section; strands across it lie turned.
TEST(PeriodicWindow, OfFullWidthStrandsPressesAsASection) {
  constexpr double kDeep = 4 * kCellLength, kLong = 12, kAbout = 0.25, kSide = 0.03;
  struct Piece {
    int row;
    double from, to, angle;
  };
  const std::vector<Piece> pieces{{0, 0, 6, 0}, {0, 7.2, 11.2, 0}, {1, -1.2, 2.4, 90}, {1, 4, 8, 90}, {2, 2, 10, 0}};
  Panel<2> section;
  section.length_mm = kLong;
  section.initial_thickness_mm = section.top_mm = 3 * kLayer;
  std::vector<Plank> planks;
  for (const auto& p : pieces) {
    section.strands.push_back(strand<2>(poplar(true), p.angle, p.row, Vec<2>(p.from, p.row * kLayer),
                                        Vec<2>(p.to, (p.row + 1) * kLayer),
                                        {static_cast<int>(std::lround(2 * (p.to - p.from) / kCellLength)), 6}));
    const double along = p.to - p.from;
    planks.push_back(
        {p.row, (p.from + p.to) / 2, kDeep / 2, p.angle == 0 ? along : kDeep, p.angle == 0 ? kDeep : along, p.angle});
  }
  const auto panel = panel_of(planks, Vec<2>(kLong, kDeep), kCellLength / 2);
  press::Resolution resolution;
  resolution.cell_aspect = kCellAspect;
  press::Schedule schedule;
  schedule.speed_m_s = 4;
  schedule.compactions = {0.29};
  auto flat = press::setup(section, resolution, mpm::Side::kPeriodic, smooth());
  auto deep = press::setup(panel, resolution, mpm::Side::kPeriodic, smooth());
  deep.grid.follow = flat.grid.follow;
  deep.grid.sides[1] = {mpm::Side::kRoller, mpm::Side::kRoller};
  const auto of_section = press::press<2>(section, schedule, flat, {});
  const auto of_plate = press::press<3>(panel, schedule, deep, {});
  report("torus mat of full-width strands against its section, stress at C = 0.25",
         stress_about(of_plate.records, kAbout, kSide) / stress_about(of_section.records, kAbout, kSide),
         near(1, 1e-3).because("contact is chaotic: another processor may take another path"));
}

// The cells' height follows the strands, not the platens, while a void closes.
TEST(CellHeight, FollowsTheStrands) {
  Panel<2> panel;
  panel.length_mm = 4;
  panel.initial_thickness_mm = panel.top_mm = 4 * kLayer;  // three rows of wood and one of nothing
  for (int row = 0; row < 3; ++row) {
    panel.strands.push_back(
        strand<2>(poplar(false), 0, row, Vec<2>(0, row * kLayer), Vec<2>(4, (row + 1) * kLayer), {20, 6}));
  }
  press::Resolution resolution;
  resolution.cell_aspect = 1.5;
  auto setup = press::setup(panel, resolution, mpm::Side::kRoller, smooth());
  setup.grid.follow = mpm::Follow::kStrands;
  std::vector<mpm::Body<2>> bodies;
  for (const auto& s : panel.strands) bodies.push_back(mpm::body_of(s));
  mpm::Engine<2> engine(bodies, setup.grid, smooth());
  engine.set_platens({0, 0}, {panel.top_mm, -8000});
  while (engine.state().top.position > 3.02 * kLayer) engine.step();
  EXPECT_EQ(engine.state().cell_stretch, 1) << "the void has closed, no strand is touched";
  while (engine.state().top.position > 2.4 * kLayer) engine.step();
  report("cells of a mat with a void at 20 % compaction of its wood, stretch", engine.state().cell_stretch,
         near(0.8, 0.01));
}

// Turned strands on a torus, a run broken off and gone on with, one thread and two.
TEST(PeriodicWindow, GivesTheSameBitsOnAnyThreadsAndOverARestart) {
  const auto panel = panel_of(turned_planks(), kTorus, kCellLength / 2);
  struct Run {
    std::vector<Panel<3>> panels;
    std::vector<press::Checkpoint<3>> checkpoints;
    press::Outcome<3> outcome;
  };
  const auto run = [&](int threads, const std::optional<press::Checkpoint<3>>& resume) {
    press::Resolution resolution;
    resolution.cell_aspect = kCellAspect;
    auto options = smooth();
    options.threads = threads;
    press::Schedule schedule;
    schedule.speed_m_s = 64;
    schedule.compactions = {0.0713, 0.2};
    Run result;
    press::Sink<3> sink;
    sink.snapshot = [&](const Panel<3>& p, int) { result.panels.push_back(p); };
    sink.checkpoint = [&](const press::Checkpoint<3>& c) { result.checkpoints.push_back(c); };
    sink.checkpoint_interval_s = 1e9;
    result.outcome =
        press::press<3>(panel, schedule, press::setup(panel, resolution, mpm::Side::kPeriodic, options), sink, resume);
    return result;
  };
  const auto whole = run(1, std::nullopt), two = run(2, std::nullopt), again = run(1, whole.checkpoints.front());
  EXPECT_LT(whole.checkpoints.back().engine.cell_stretch, 0.95);  // there is something to restore
  for (const auto* other : {&two, &again}) {
    for (std::size_t s = 0; s < panel.strands.size(); ++s) {
      for_each_field<3>([&](const auto& field) {
        EXPECT_THAT(whole.panels.back().strands[s].points.*field.values,
                    test::SameBits(other->panels.back().strands[s].points.*field.values))
            << "strand " << s << ", " << field.name;
      });
    }
    EXPECT_EQ(other->outcome.most_fields, whole.outcome.most_fields);
  }
  report("torus mat of three layers, fields at a node at most", whole.outcome.most_fields,
         between(3, mpm::kMaxFields - 1));
}

}  // namespace
}  // namespace strandlab::press_tests
