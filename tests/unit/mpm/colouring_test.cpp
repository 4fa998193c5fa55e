// Tiles of one colour scatter at the same time without locks: they must share no node.
#include "strandlab/mpm/colouring.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "strandlab/core/error.hpp"
#include "support/strands.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::mpm {
namespace {

constexpr double kCell = 0.25;  // mm, two particles

// A strand along x of 96 x 6 particles (x 40 across): three tiles in a row (and in 3D three rows of six).
template <int Dim>
Body<Dim> long_strand() {
  std::array<int, Dim> counts{};
  counts.fill(40);
  counts[0] = 96;
  counts[Dim - 1] = 6;
  auto s = test::strand_from<Dim>(wood::in_strand_axes(wood::library().front(), 0), Vec<Dim>::Zero(),
                                  Vec<Dim>::Constant(kCell / 2), counts);
  s.kind = "surface";
  return body_of(s);
}

template <int Dim>
Step<Dim> first_step() {
  Step<Dim> f{};
  for (int a = 0; a < Dim; ++a) {
    f.cell[a] = kCell;
    f.inverse_cell[a] = 1 / kCell;
    f.wall[a][0] = f.wall[a][1] = kNoWall;
  }
  return f;
}

// What the check says of the strand's tiles, coloured by split_into_tiles or by `recolour`.
template <int Dim, class Recolour>
std::string verdict(const Recolour& recolour) {
  std::vector<ColouredTile> tiles;
  std::vector<Particles<Dim>> bodies;
  bodies.push_back(store_particles(long_strand<Dim>(), 0, tiles));
  for (std::size_t t = 0; t < tiles.size(); ++t) recolour(t, tiles[t].colour);
  try {
    check_colouring(sort_by_colour(tiles), bodies, first_step<Dim>(), EngineState{});
  } catch (const RunError& error) {
    return error.what();
  }
  return "apart";
}

template <int Dim>
void expect_judged() {
  EXPECT_EQ(verdict<Dim>([](std::size_t, int&) {}), "apart");
  const auto message = verdict<Dim>([](std::size_t, int& colour) { colour = 0; });  // neighbours of one colour
  for (const char* part : {"step 0", "two parts of surface strand in row 1", "at the same time", " mm"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(Colouring, OfNeighboursMustDiffer2D) {
  expect_judged<2>();
}
TEST(Colouring, OfNeighboursMustDiffer3D) {
  expect_judged<3>();
  // Rows across are neighbours too: colours along alone do not do.
  EXPECT_NE(verdict<3>([](std::size_t, int& colour) { colour %= 2; }), "apart");
}

// A strand folded onto itself so far that its first and third tile meet cannot be scattered without locks: the engine
// says so before it loses a force.
TEST(Colouring, FoldedStrandStopsTheRun) {
  auto body = long_strand<2>();
  for (std::size_t p = 0; p < body.points.x.size(); ++p) {
    const std::size_t column = p % 96;
    if (column >= 48)
      body.points.x[p] += Vec<2>(static_cast<double>(95 - 2 * static_cast<int>(column)) * kCell / 2, 0.4);
  }
  Grid<2> grid;
  grid.cell = Vec<2>::Constant(kCell);
  grid.origin = grid.lo = Vec<2>::Constant(-4);
  grid.hi = Vec<2>::Constant(20);
  Engine<2> engine({body}, grid, {});
  const auto message = test::message_of<RunError>([&] { engine.step(); });
  EXPECT_NE(message.find("folded onto itself"), std::string::npos) << message;
}

}  // namespace
}  // namespace strandlab::mpm
