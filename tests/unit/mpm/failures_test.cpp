// What stops the engine: each failure names the step, the time, the strand and the place.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "strandlab/core/error.hpp"
#include "strandlab/mpm/engine.hpp"
#include "strandlab/panel/panel.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::mpm {
namespace {

constexpr double kThick = 0.8, kLength = 2.4;  // mm

Strand<2> piece_of(double x0, double x1) {
  mat::Mat mat;
  mat.length_mm = kLength;
  mat.layer_thickness_mm = kThick;
  mat::Layer layer;
  layer.role = "surface";
  layer.strands.emplace_back();
  layer.strands.back().x0_mm = x0;
  layer.strands.back().x1_mm = x1;
  mat.layers.push_back(layer);
  return make_panel(mat, {{"surface", wood::library().front(), 0}}, kThick / 6, 6).strands.front();
}

Body<2> strand_of(double x0, double x1) {
  return body_of(piece_of(x0, x1));
}

Engine<2> engine_of(const std::vector<Body<2>>& bodies, Side side = Side::kRoller) {
  Grid<2> grid;
  grid.cell = Vec<2>::Constant(kThick / 3);
  grid.origin = grid.lo = Vec<2>::Zero();
  grid.hi = Vec<2>(kLength, kThick);
  grid.sides[0] = {side, side};
  Engine<2> engine(bodies, grid, Options{});
  engine.set_platens({0, 0}, {kThick, 0});
  return engine;
}

std::string failure_of(const Body<2>& body) {
  return test::message_of<RunError>([&] { engine_of({body}).step(); });
}

void expect_says(const std::string& message, const std::vector<std::string>& parts) {
  for (const auto& part : parts) EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(Failure, InvertedParticle) {
  auto body = strand_of(0, kLength);
  body.points.F[40](1, 1) = -0.5;  // turned inside out
  expect_says(failure_of(body),
              {"step 0", "ms", "particle 40 of surface strand in row 1", " mm", "inverted (det F = -"});
}

TEST(Failure, StressThatIsNotANumber) {
  auto body = strand_of(0, kLength);
  body.points.stress[40][0] = std::numeric_limits<double>::quiet_NaN();
  expect_says(failure_of(body), {"step 0", "surface strand in row 1", " mm", "stress is not finite"});
}

TEST(Failure, TimeStepThatFallsToNothing) {
  auto body = strand_of(0, kLength);
  for (auto& v : body.points.v) v[0] = 1;  // mm/s
  auto engine = engine_of({body});
  engine.scale_velocities(1e12);
  expect_says(test::message_of<RunError>([&] { engine.step(); }),
              {"step 0", "the time step fell to", "surface strand in row 1 at ("});
}

TEST(Failure, ParticleOutsideTheGrid) {
  auto body = strand_of(0, kLength);
  body.points.x[40][0] = 3 * kLength;
  expect_says(failure_of(body), {"step 0", "particle 40 of surface strand in row 1", "left the grid"});
}

// A strand as long as the mat, pushed out by its whole length: it is beside the mat, not lost. Further off it is.
TEST(Failure, AFreeSideLetsAWholeStrandGo) {
  auto strand = piece_of(0, kLength);
  for (auto& x : strand.points.x) x[0] += kLength;
  EXPECT_NO_THROW(engine_of({body_of(strand)}, Side::kFree).step());
  for (auto& x : strand.points.x) x[0] += kLength;
  expect_says(test::message_of<RunError>([&] { engine_of({body_of(strand)}, Side::kFree).step(); }), {"left the grid"});
}

// A strand in flight reaches the end of the room beside the mat: a run that goes on from a state on the way says so at
// the same step, in the same words.
TEST(Failure, ComesAtTheSameStepAfterARestart) {
  Panel<2> panel;
  panel.strands.push_back(piece_of(0, kLength));
  for (auto& x : panel.strands[0].points.x) x[0] += kLength + 0.3;  // its end is 0.3 mm before the end of the room
  for (auto& v : panel.strands[0].points.v) v[0] = 1e5;             // mm/s
  const auto failure = [](Engine<2>& engine) {
    return test::message_of<RunError>([&] {
      while (engine.state().step < 1000) engine.step();
    });
  };
  auto undisturbed = engine_of({body_of(panel.strands[0])}, Side::kFree);
  const auto message = failure(undisturbed);
  expect_says(message, {"left the grid"});
  for (const int stop : {1, 37, 50}) {
    auto first = engine_of({body_of(panel.strands[0])}, Side::kFree);
    while (first.state().step < stop) first.step();
    Panel<2> state = panel;
    first.write(state);
    auto second = engine_of({body_of(state.strands[0])}, Side::kFree);
    second.resume(first.state());
    EXPECT_EQ(failure(second), message) << "stopped at step " << stop;
  }
}

TEST(Failure, ParticleStretchedOutOfProportion) {
  auto body = strand_of(0, kLength);
  body.points.F[0](0, 0) = 50;  // in the strand's bottom left corner: a point of its end face lies 25 spacings outside
  expect_says(failure_of(body), {"step 0", "surface strand in row 1 at (", "stretched out of all proportion"});
}

TEST(Failure, TractionOnAFaceThatIsNotThere) {
  auto engine = engine_of({strand_of(0, kLength)});
  engine.set_traction(0, 3, Vec<2>(1, 0));
  for (const auto& [body, face] : {std::pair{1, 0}, {-1, 0}, {0, 4}, {0, -1}}) {
    expect_says(test::message_of<InputError>([&, b = body, f = face] { engine.set_traction(b, f, Vec<2>::Zero()); }),
                {"face " + std::to_string(face) + " of body " + std::to_string(body), "not there"});
  }
}

// As many as a node holds go on; one more is an error, not a body forgotten.
TEST(Failure, MoreBodiesAtANodeThanItHolds) {
  const std::vector<Body<2>> most(24, strand_of(0, kLength));
  engine_of(most).step();
  const std::vector<Body<2>> too_many(25, strand_of(0, kLength));
  expect_says(test::message_of<RunError>([&] { engine_of(too_many).step(); }),
              {"step 0", "ms", "more than 24 bodies meet at one grid node", "x = "});
}

// A pile of rows so thin that all of them meet at the same nodes, each falling on the one below: two settle in one
// pass, ten hand their impulses on from row to row and do not settle in 40. Nothing stops; the state counts the nodes.
TEST(Contact, ThatDoesNotSettleIsCounted) {
  const auto unsettled = [](int rows) {
    mat::Mat mat;
    mat.length_mm = kLength;
    mat.layer_thickness_mm = 0.04;
    for (int row = 0; row < rows; ++row) {
      mat.layers.emplace_back().role = "surface";
      mat.layers.back().strands.emplace_back().x1_mm = kLength;
    }
    std::vector<Body<2>> bodies;
    for (const auto& strand : make_panel(mat, {{"surface", wood::library().front(), 0}}, 0.1, 2).strands) {
      bodies.push_back(body_of(strand));
      for (auto& v : bodies.back().points.v) v = Vec<2>(0, -1000.0 * strand.row);  // mm/s
    }
    Grid<2> grid;
    grid.cell = Vec<2>::Constant(kThick / 3);
    grid.origin = Vec<2>::Zero();
    grid.lo = Vec<2>::Constant(-2);
    grid.hi = Vec<2>::Constant(4);
    Engine<2> engine(bodies, grid, Options{});
    engine.step();
    return engine.state().unconverged_contacts;
  };
  EXPECT_EQ(unsettled(2), 0);
  EXPECT_GT(unsettled(10), 0);
}

// A strand far thinner than a cell has no stable motion between its neighbours. It may fail, with a message; it
// must never write outside its windows (the sanitizers watch).
TEST(Failure, SliverNeverLeavesItsWindows) {
  const std::vector<Body<2>> bodies{strand_of(0, 1.1), strand_of(1.1, 1.1003), strand_of(1.1003, kLength)};
  auto engine = engine_of(bodies);
  engine.set_platen_velocities(0, -64000);
  try {
    while (engine.state().top.position > 0.8 * kThick) engine.step();
  } catch (const RunError& error) {
    expect_says(error.what(), {"step", "strand in row 1"});
    return;
  }
  EXPECT_LE(engine.state().top.position, 0.8 * kThick);
}

}  // namespace
}  // namespace strandlab::mpm
