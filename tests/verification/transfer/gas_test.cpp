// Flow of gas through the mat and to the edges of the panel.
#include <gtest/gtest.h>

#include <cmath>

#include "mats.hpp"
#include "support/report.hpp"

namespace strandlab::transfer {
namespace {

using namespace test;

constexpr double kAtmosphere = 101325;

Constants of_permeability(double K) {
  Constants k;
  k.permeability_400 = 0;
  k.permeability_floor = K;
  return k;
}

Side<double> steam(double p, double half_length, double K) {
  const double RT = kGasConstant * (120 + kZeroCelsius);
  return {120, p, 1, p / RT, 0, 0, 1, 1, half_length / K};
}

// Steam of 120 C from a uniform source S over a length closed at one end, to the air pressure at the other:
// p_c = sqrt(p_0^2 + S mu R T L^2/(K M_w)) at the closed end. Darcy flow with the mean density of both cells is exact
// in p^2, so that the cell at the closed end has this pressure on any grid.
TEST(Gas, SteamFromAUniformSourceToAnOpenEnd) {
  const double K = 1e-12, S = .02, L = .3;
  const auto k = of_permeability(K);
  const double RT = kGasConstant * (120 + kZeroCelsius);
  const double exact = std::sqrt(kAtmosphere * kAtmosphere + S * k.viscosity * RT * L * L / (K * kMolarMassWater));
  EXPECT_NEAR(exact, 120468.4, .05);
  for (const int cells : {1, 4, 20}) {
    const double h = L / cells;
    auto out = steam(kAtmosphere, 0, K);
    for (int i = cells - 1; i >= 0; --i) {  // from the open end: the pressure that drives the known flow
      double low = out.p, high = 2 * out.p;
      for (int n = 0; n < 100; ++n) {
        const double p = .5 * (low + high);
        (face_flux(k, steam(p, h / 2, K), out)[kWater] < S * (i + 1) * h ? low : high) = p;
      }
      out = steam(low, h / 2, K);
    }
    EXPECT_NEAR(out.p, exact, 1e-6 * exact) << cells;
  }
}

// The sink to the edges is this solution for a strip of width 2 L: with the same source the same pressure.
TEST(Gas, SinkToTheEdgesIsTheSteadyStrip) {
  Constants k;
  k.panel_width = .6;
  Cell<double> cell;
  cell.T = 120;
  cell.p = 120468.4;
  cell.y = 1;
  cell.c = cell.p / (kGasConstant * 393.15);
  cell.conductivity = cell.diffusion = 1;
  cell.vapour_enthalpy = vapour_enthalpy(k, 120.);
  cell.air_enthalpy = 0;
  cell.permeability = 1e-12 / k.permeability_in_plane;
  const double thickness = .002;
  const auto flux = edge_flux(k, cell, thickness);
  EXPECT_NEAR(flux[kWater], .02 * thickness, 1e-5 * .02 * thickness);
  EXPECT_DOUBLE_EQ(flux[kAir], 0);
  EXPECT_NEAR(flux[kEnergy], flux[kWater] * (2.501e6 + 1880 * 120), 1e-9 * flux[kEnergy]);
}

// Below the room's pressure the room's air comes in, at its temperature and humidity.
TEST(Gas, AirOfTheRoomComesInThroughTheEdges) {
  const Constants k;
  const auto cell = cell_at<double>(k, .1, .0002, 90, .05, 1e4);
  ASSERT_LT(cell.p, kAtmosphere);
  const auto flux = edge_flux(k, cell, .0002);
  EXPECT_LT(flux[kAir], 0);
  const double y = .5 * saturation_pressure(20.) / kAtmosphere;
  EXPECT_NEAR(flux[kWater] / flux[kAir], y / (1 - y) * kMolarMassWater / kMolarMassAir, 1e-12);
  EXPECT_NEAR(flux[kEnergy], flux[kWater] * vapour_enthalpy(k, 20.) + flux[kAir] * air_enthalpy(k, 20.), 1e-9);
}

// Small excess pressure held at the face: Darcy flow to the mid-plane against the sink, centre/face = 1/cosh(lambda L),
// lambda = sqrt(8 K_xy/K_z)/W.
TEST(Gas, SinkAgainstFlowThroughTheThickness) {
  for (const auto& [width, ratio] : {std::pair{.6, .9881}, std::pair{.05, .3043}}) {
    auto k = of_permeability(1e-14);
    k.panel_width = width;
    k.ambient_humidity = 0;
    HalfMat mat{80};
    mat.M = 0;
    auto face = open_to(k);
    face.p += 10;
    auto solver = solver_of(mat, k, face);
    march(solver, 20, .5, [&](double) { return uniform(mat, mat.thickness, face); });
    const double centre = (solver.cell(0).p - kAtmosphere) / 10;
    EXPECT_NEAR(1 / std::cosh(std::sqrt(8 * 30.) / width * .006), ratio, 6e-5);
    EXPECT_NEAR(centre, ratio, 1.2e-4) << width;
    report(width > .1 ? "centre over face, W = 0.6 m" : "centre over face, W = 0.05 m", centre,
           width > .1 ? "0.9881" : "0.3043");
    EXPECT_LT(worst_balance(solver), 1e-10);
  }
}

// One layer along the panel between two pressures: p^2 is linear, and K_xy conducts.
TEST(Gas, SteadyFlowAlongThePanel) {
  auto k = of_permeability(1e-14);
  k.ambient_humidity = 0;
  Grid grid;
  grid.rows = 1;
  grid.columns = 10;
  grid.column_width = .01;
  grid.dry_mass.assign(10, .64 * 2);
  Conditions c;
  c.thickness.assign(10, .002);
  c.left = c.right = open_to(k);
  c.left.p = 2e5;
  Solver solver(k, grid, std::vector<CellState>(10, {20, 0, kAtmosphere}), c);
  for (int i = 0; i < 200; ++i) solver.step(2, [&](double) { return c; });
  const double left = 4e10, right = kAtmosphere * kAtmosphere;
  for (int i = 0; i < 10; ++i) {
    const double p = solver.cell(i).p;
    EXPECT_NEAR(p * p, left + (right - left) * (i + .5) / 10, 2e-4 * left) << i;  // isothermal but for the films
  }
  EXPECT_LT(worst_balance(solver), 1e-10);
}

// Columns that are alike are one column: the sparse and the block solution of the same equations.
TEST(Gas, EqualColumnsAreOneColumn) {
  const Constants k;
  const HalfMat mat{10};
  const auto one = uniform(mat, mat.thickness, platen(200));
  auto single = solver_of(mat, k, one.top);
  Grid grid = single.grid();
  grid.columns = 3;
  grid.column_width = .02;
  auto three = one;
  std::vector<CellState> state;
  const auto masses = grid.dry_mass;
  for (int i = 0; i < 3; ++i) {
    state.insert(state.end(), single.state().begin(), single.state().end());
    if (i == 0) continue;
    grid.dry_mass.insert(grid.dry_mass.end(), masses.begin(), masses.end());
    three.thickness.insert(three.thickness.end(), one.thickness.begin(), one.thickness.end());
  }
  Solver several(k, grid, state, three);
  for (int i = 0; i < 100; ++i) {
    single.step(.5, [&](double) { return one; });
    several.step(.5, [&](double) { return three; });
  }
  for (int i = 0; i < 30; ++i) {
    EXPECT_NEAR(several.state()[i].T, single.state()[i % 10].T, 1e-8);
    EXPECT_NEAR(several.state()[i].M, single.state()[i % 10].M, 1e-10);
    EXPECT_NEAR(several.cell(i).p, single.cell(i % 10).p, 1e-4);
  }
  for (int row = 0; row < 3; ++row)
    EXPECT_NEAR(several.received()[row], single.received()[row], 1e-9 * std::abs(single.content()[row]));
}

// A section with open ends: both halves alike, ends at lower pressure than the middle; Garcia et al. (2001) measured
// cooler edges at lower pressure.
TEST(Gas, OpenEndsOfASection) {
  const Constants k;
  const HalfMat mat{10};
  const int columns = 6;
  auto grid = solver_of(mat, k).grid();
  const auto masses = grid.dry_mass;
  grid.columns = columns;
  grid.column_width = .03;
  Conditions c = uniform(mat, mat.thickness, platen(200));
  const auto thickness = c.thickness;
  std::vector<CellState> state;
  for (int i = 0; i < columns; ++i) {
    const auto start = solver_of(mat, k).state();
    state.insert(state.end(), start.begin(), start.end());
    if (i == 0) continue;
    grid.dry_mass.insert(grid.dry_mass.end(), masses.begin(), masses.end());
    c.thickness.insert(c.thickness.end(), thickness.begin(), thickness.end());
  }
  c.left = c.right = open_to(k);
  Solver solver(k, grid, state, c);
  for (int i = 0; i < 240; ++i) solver.step(.5, [&](double) { return c; });
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < 10; ++row) {
      const auto &here = solver.state()[column * 10 + row], &there = solver.state()[(columns - 1 - column) * 10 + row];
      EXPECT_NEAR(here.T, there.T, 1e-6);
      EXPECT_NEAR(here.M, there.M, 1e-8);
    }
  }
  EXPECT_LT(solver.cell(0).p, solver.cell(10).p);
  EXPECT_LT(solver.cell(10).p, solver.cell(20).p);
  EXPECT_LT(solver.state()[0].T, solver.state()[20].T);
  EXPECT_LT(worst_balance(solver), 1e-10);
}

}  // namespace
}  // namespace strandlab::transfer
