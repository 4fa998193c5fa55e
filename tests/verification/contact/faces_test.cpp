// Which faces meet: from how far they see each other, and at which angle to each other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/report.hpp"
#include "verification/contact/bodies.hpp"

namespace strandlab::contact_tests {
namespace {

constexpr double kFaceCell = 0.25;  // mm

mpm::Grid<2> open_grid(double offset_cells = 0) {
  mpm::Grid<2> grid;
  grid.cell = Vec<2>::Constant(kFaceCell);
  grid.origin = Vec<2>::Constant(offset_cells * kFaceCell);
  grid.lo = Vec<2>::Constant(-8);
  grid.hi = Vec<2>::Constant(8);
  return grid;
}

// Two blocks `gap` cells apart that would be 0.05 cell into each other after one step.
std::vector<mpm::Body<2>> about_to_meet(double gap) {
  const auto material = elastic_material(1000, 0.3);
  std::vector<mpm::Body<2>> bodies{
      block<2>(material, Vec<2>(0, -4 * kFaceCell), Vec<2>(8 * kFaceCell, 0), kFaceCell / 2),
      block<2>(material, Vec<2>(0, gap * kFaceCell), Vec<2>(8 * kFaceCell, (4 + gap) * kFaceCell), kFaceCell / 2)};
  // The faster they are the shorter the step.
  const double way = (gap + 0.05) * kFaceCell;
  for (int i = 0; i < 100; ++i) {
    const double dt = mpm::Engine<2>(bodies, open_grid(), {}).state().time_step_s;
    for (auto& v : bodies[1].points.v) v[1] = -way / dt;
  }
  const double dt = mpm::Engine<2>(bodies, open_grid(), {}).state().time_step_s;
  EXPECT_NEAR(-bodies[1].points.v[0][1] * dt / way, 1, 1e-6);
  return bodies;
}

// Faces that would cross within the next step are stopped where they touch: seen from up to a quarter cell away, one
// step is enough. The grid stops the mean of the particles behind a face, hence the few hundredths of a cell left.
TEST(Faces, AreStoppedInTheStepInWhichTheyWouldCross) {
  for (const double gap : {0.1, 0.2}) {
    for (const double offset : {0.0, 0.3, 0.5}) {
      auto bodies = about_to_meet(gap);
      mpm::Engine<2> engine(bodies, open_grid(offset), {});
      engine.step();
      engine.write(bodies);
      report(fmt::format("blocks {} cells apart, grid offset {}, that would cross by .05: gap after one step", gap,
                         offset),
             (face_position(bodies[1], 0, 1) - face_position(bodies[0], 1, 1)) / kFaceCell, between(-0.02, 0.02),
             "cells");
    }
  }
}

// A block that stands on its edge, its faces at 135 degrees to the one below, falls on it and is turned back: faces
// that oppose each other by more than 120 degrees meet. None would meet from 160 degrees on, and it would sink in.
TEST(Faces, OfABlockOnEdgeMeetTheFaceBelow) {
  const auto material = elastic_material(1000, 0.3);
  auto base = block<2>(material, Vec<2>(-4, -1), Vec<2>(4, 0), kFaceCell / 2);
  auto falling = block<2>(material, Vec<2>(-1, -1), Vec<2>(1, 1), kFaceCell / 2);
  Tensor<2> turn;
  turn << std::sqrt(0.5), -std::sqrt(0.5), std::sqrt(0.5), std::sqrt(0.5);
  const Vec<2> centre(0, std::sqrt(2.0) + 0.5 * kFaceCell);
  for (std::size_t p = 0; p < falling.points.x.size(); ++p) {
    falling.points.x[p] = centre + turn * falling.points.x[p];
    falling.points.F[p] = turn;
    falling.points.v[p] = Vec<2>(0, -10000);
  }
  std::vector<mpm::Body<2>> bodies{base, falling};
  mpm::Grid<2> grid = open_grid(0.3);
  mpm::Engine<2> engine(bodies, grid, {});
  engine.set_platens({-1, 0}, {8, 0});
  double lowest = 1e300;
  for (int step = 0; step < 1500; ++step) {
    engine.step();
    engine.write(bodies);
    double tip = 1e300, below_it = -1e300;
    for (const auto& x : bodies[1].points.x) tip = std::min(tip, x[1]);
    for (const auto& x : bodies[0].points.x) {
      if (std::abs(x[0]) < kFaceCell) below_it = std::max(below_it, x[1]);
    }
    lowest = std::min(lowest, (tip - below_it) / kFaceCell);
  }
  const double speed = mean<2>(bodies[1].points.v)[1];
  // The outermost particles are a quarter cell below a face and .35 cell above the edge when these touch.
  report("block on edge: least distance of its lowest particle from those of the face below", lowest, above(0.1),
         "cells");
  report("block on edge: speed away over speed of approach", speed / 10000, above(0.2));
}

}  // namespace
}  // namespace strandlab::contact_tests
