// What the solver refuses, and the smallest linear systems.
#include "strandlab/transfer/solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "strandlab/core/error.hpp"
#include "strandlab/transfer/cure.hpp"
#include "strandlab/transfer/linear.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::transfer {
namespace {

Conditions two_cells() {
  Conditions c;
  c.thickness = {.001, .001};
  return c;
}

Grid grid_of_two() {
  Grid grid;
  grid.rows = 2;
  grid.dry_mass = {.6, .6};
  return grid;
}

std::string refusal(const Grid& grid, const std::vector<CellState>& state, const Conditions& conditions) {
  return test::message_of<InputError>([&] { Solver({}, grid, state, conditions); });
}

TEST(Solver, RefusesSizesThatDoNotFit) {
  EXPECT_EQ(refusal(grid_of_two(), {{20, .08, 1e5}}, two_cells()),
            "1 x 2 cells with 2 dry masses, 1 states and 2 thicknesses");
}

TEST(Solver, RefusesEmptyCellsAndWoodTooWet) {
  auto grid = grid_of_two();
  EXPECT_EQ(refusal(grid, {{20, .08, 1e5}, {20, .6, 1e5}}, two_cells()),
            "cell 1 has moisture content 0.6; it must be from 0 to 0.5");
  grid.dry_mass[0] = 0;
  EXPECT_EQ(refusal(grid, {{20, .08, 1e5}, {20, .08, 1e5}}, two_cells()),
            "cell 0 has dry mass 0 kg/m2 and thickness 0.001 m; both must be greater than 0");
}

TEST(Solver, ABalanceThatIsOffStopsTheRun) {
  check_balances({1e-6, -1e-6, 0}, 3);
  EXPECT_EQ(test::message_of<RunError>([] {
              check_balances({0, -2e-6, 0}, 3.5);
            }),
            "balance of air at 3.5 s is off by -2e-06 of what there is (at most 1e-06)");
}

// A platen that has no temperature leaves no solution, however short the step.
TEST(Solver, SaysWhereThereIsNoSolution) {
  Solver solver({}, grid_of_two(), {{20, .08, 1e5}, {20, .08, 1e5}}, two_cells());
  auto c = two_cells();
  c.top = platen(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(test::message_of<RunError>([&] { solver.step(1, [&](double) { return c; }); }),
            "heat and moisture: no solution at 0 s, not even with a step of 6.1e-05 s");
}

// Block elimination of a column, of cells in a row and of several columns, few or many, against a dense solution.
TEST(Linear, EliminationOfAnyGridIsThatOfTheWholeMatrix) {
  const auto block = [](int seed) {
    Block b;
    for (int i = 0; i < 9; ++i) b(i / 3, i % 3) = std::sin(seed + 1.7 * i);
    return b;
  };
  for (const auto& [rows, columns] : {std::pair{5, 1}, {1, 5}, {5, 3}, {3, 5}, {4, 4}}) {
    SCOPED_TRACE(std::to_string(rows) + " rows of " + std::to_string(columns));
    Grid grid;
    grid.rows = rows;
    grid.columns = columns;
    const auto faces = faces_of(grid);
    const int n = 3 * grid.cells();
    BlockSystem system;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i < grid.cells(); ++i) {
      system.diagonal.push_back(block(i) + 7 * Block::Identity());
      dense.block<3, 3>(3 * i, 3 * i) = system.diagonal.back();
    }
    for (std::size_t f = 0; f < faces.size(); ++f) {
      system.a_by_b.push_back(block(100 + static_cast<int>(f)));
      system.b_by_a.push_back(block(200 + static_cast<int>(f)));
      dense.block<3, 3>(3 * faces[f].a, 3 * faces[f].b) = system.a_by_b.back();
      dense.block<3, 3>(3 * faces[f].b, 3 * faces[f].a) = system.b_by_a.back();
    }
    system.right = Eigen::VectorXd::LinSpaced(n, -1, 2);
    const Eigen::VectorXd exact = dense.partialPivLu().solve(system.right);
    Elimination elimination(grid);
    EXPECT_LT((elimination.solve(faces, system) - exact).norm(), 1e-12);
    system.diagonal[2].setZero();
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (faces[f].a == 2) system.a_by_b[f].setZero();
      if (faces[f].b == 2) system.b_by_a[f].setZero();
    }
    EXPECT_EQ(elimination.solve(faces, system).size(), 0);
  }
}

TEST(Cure, BondStrengthStartsAtTheGelPoint) {
  const auto& pf = resins()[0];
  EXPECT_DOUBLE_EQ(bond_strength(pf, .4), 0);
  EXPECT_DOUBLE_EQ(bond_strength(pf, .75), .5);
  EXPECT_DOUBLE_EQ(bond_strength(pf, 1), 1);
}

// Order below 1: cure ends in finite time.
TEST(Cure, OrderBelowOneIsDoneInFiniteTime) {
  const Resin resin{"fast", 0, 1, .5, .5};
  EXPECT_NEAR(cured(resin, 0, 20, 1), 1 - .25, 1e-12);  // sqrt(1 - alpha) = 1 - t/2
  EXPECT_DOUBLE_EQ(cured(resin, 0, 20, 3), 1);
  EXPECT_DOUBLE_EQ(cured(resin, 1, 20, 3), 1);
}

}  // namespace
}  // namespace strandlab::transfer
