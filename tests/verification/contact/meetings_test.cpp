// Several bodies at one node, and flat faces that touch from the start.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/report.hpp"
#include "verification/contact/bodies.hpp"

namespace strandlab::contact_tests {
namespace {

constexpr double kMeetingCell = 0.25;  // mm

// Three rows one cell thick, each cut in two at the same place: six bodies share the nodes of the middle row there, as
// in a mat pressed to 40 %. The left halves run to the right, so that the ends meet too. Returned in the order of
// construction.
std::vector<mpm::Body<2>> press_three_rows(const std::vector<std::size_t>& order) {
  std::vector<mpm::Body<2>> made;
  const auto material = elastic_material(1000, 0.3);
  for (int row = 0; row < 3; ++row) {
    for (int half = 0; half < 2; ++half) {
      made.push_back(block<2>(material, Vec<2>(half * 2.0, row * kMeetingCell),
                              Vec<2>(half * 2.0 + 2.0, (row + 1) * kMeetingCell), kMeetingCell / 4));
      for (auto& v : made.back().points.v) v = Vec<2>((1 - half) * 2000.0 + 300.0 * row, 100.0 * half);
    }
  }
  std::vector<mpm::Body<2>> shuffled;
  shuffled.reserve(order.size());
  for (std::size_t i : order) shuffled.push_back(made[i]);
  mpm::Grid<2> grid;
  grid.cell = Vec<2>(kMeetingCell, kMeetingCell);
  grid.origin = Vec<2>(0, 0.5 * kMeetingCell);
  grid.lo = Vec<2>(-2, -1);
  grid.hi = Vec<2>(8, 2);
  mpm::Engine<2> engine(shuffled, grid, mpm::Options{});
  engine.set_platens({0, 0}, {3 * kMeetingCell, -4000});
  for (int i = 0; i < 200; ++i) engine.step();
  engine.write(shuffled);
  for (std::size_t i = 0; i < order.size(); ++i) made[order[i]] = shuffled[i];
  return made;
}

// Contact of many bodies at a node is one problem, not a sequence of pairs: the order of the bodies changes round-off
// only.
TEST(Meetings, ThreeRowsWithTwoEndsEachDoNotDependOnBodyOrder) {
  const auto reference = press_three_rows({0, 1, 2, 3, 4, 5});
  double moved = 0, worst = 0;
  for (const auto& body : reference) {
    for (const auto& v : body.points.v) moved = std::max(moved, v.norm());
  }
  for (const auto& order :
       std::vector<std::vector<std::size_t>>{{5, 4, 3, 2, 1, 0}, {2, 0, 5, 3, 1, 4}, {1, 0, 3, 2, 5, 4}}) {
    const auto other = press_three_rows(order);
    double dx = 0, dv = 0;
    for (std::size_t b = 0; b < reference.size(); ++b) {
      for (std::size_t p = 0; p < reference[b].points.size(); ++p) {
        dx = std::max(dx, (other[b].points.x[p] - reference[b].points.x[p]).norm() / kMeetingCell);
        dv = std::max(dv, (other[b].points.v[p] - reference[b].points.v[p]).norm() / moved);
      }
    }
    worst = std::max(worst, dx);
    EXPECT_LT(dv, 1e-10);  // velocities carry round-off times the elastic waves' stiffness
  }
  report("six bodies at a node in three other orders: positions", worst, below(1e-12).because(test::kRoundOff),
         "cells");
}

class TouchingFaces : public testing::TestWithParam<double> {};

// Two flat blocks that touch when the press starts stay in touch: neither a gap nor an overlap builds up, wherever the
// faces lie between grid lines. Mean over the faces and over the pressing to 5 %.
TEST_P(TouchingFaces, KeepNoGapAndNoOverlap) {
  const auto material = elastic_material(1000, 0.3);
  const double thickness = 3 * kMeetingCell, length = 8 * kMeetingCell, offset = GetParam() * kMeetingCell;
  std::vector<mpm::Body<2>> bodies;
  bodies.reserve(2);
  for (int row = 0; row < 2; ++row) {
    bodies.push_back(
        block<2>(material, Vec<2>(0, row * thickness), Vec<2>(length, (row + 1) * thickness), kMeetingCell / 2));
  }
  mpm::Grid<2> grid;
  grid.cell = Vec<2>(kMeetingCell, kMeetingCell);
  grid.origin = Vec<2>(0, -offset);
  grid.lo = Vec<2>(0, 0);
  grid.hi = Vec<2>(length, 2 * thickness);
  grid.sides[0] = {mpm::Side::kRoller, mpm::Side::kRoller};
  mpm::Engine<2> engine(bodies, grid, mpm::Options{});
  engine.set_platens({0, 0}, {2 * thickness, 0});
  double sum = 0, worst = 0;
  int count = 0;
  const double ramp = 2e-5;
  while (engine.state().top.position > 0.95 * 2 * thickness) {
    engine.set_platen_velocities(0, -2000 * std::min(1.0, engine.state().time_s / ramp));
    engine.step();
    engine.write(bodies);
    const double gap = (face_position(bodies[1], 0, 1) - face_position(bodies[0], 1, 1)) / kMeetingCell;
    sum += gap;
    worst = std::max(worst, std::abs(gap));
    ++count;
  }
  const std::string at = "touching faces, grid offset " + testing::PrintToString(GetParam());
  report("mean gap of " + at, sum / count, within(1.5e-6), "cells");
  report("largest gap or overlap of " + at, worst, below(4e-6), "cells");
}
INSTANTIATE_TEST_SUITE_P(Contact, TouchingFaces, testing::Values(0.0, 0.25, 0.37, 0.5));

}  // namespace
}  // namespace strandlab::contact_tests
