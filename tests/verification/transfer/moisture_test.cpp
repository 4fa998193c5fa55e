// Moisture at constant temperature: diffusion of vapour in air, flow of steam through sorbing wood, both together.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "mats.hpp"
#include "support/report.hpp"

namespace strandlab::transfer {
namespace {

using namespace test;

constexpr double kLength = .006;

// Wood so heavy on heat that nothing changes its temperature; porosity .5; relative humidity M/.25; closed.
Constants isothermal(double K) {
  Constants k;
  k.wood_heat = 1e12;
  k.linear_isotherm = .25;
  k.cell_wall_density = 1e-12;  // no room for pores: their share is the floor
  k.porosity_floor = .5;
  k.permeability_400 = 0;
  k.permeability_floor = K;
  k.panel_width = kInfinite;
  return k;
}

// Part of cos(pi x/L) in values at cell centres.
template <class Value>
double amplitude(int cells, Value value) {
  double sum = 0;
  for (int i = 0; i < cells; ++i) sum += value(i) * std::cos(std::numbers::pi * (i + .5) / cells) * 2 / cells;
  return sum;
}

double wave(double depth) {
  return std::cos(std::numbers::pi * (1 - depth));
}

struct Decay {
  int cells;
  double step;
  std::array<double, 3> amplitude;
};

class BinaryDiffusion : public testing::TestWithParam<Decay> {};

// No sorption: vapour and air change places, y = .3 + .1 cos(pi x/L) decays by exp(-pi^2 D_e t/(eps L^2)).
TEST_P(BinaryDiffusion, AmplitudeOfAWave) {
  const auto& p = GetParam();
  auto k = isothermal(1e-11);
  k.wood_heat = 1e22;
  const double T = 100, atmosphere = 101325;
  k.diffusion_factor = 1e-6 / diffusivity(k, .5, T, atmosphere) * k.diffusion_factor;
  HalfMat mat{p.cells};
  mat.dry_density = 1e-9;  // hardly any wood
  mat.T = T;
  mat.M_at = [&](double depth) { return .25 * (.3 + .1 * wave(depth)) * atmosphere / saturation_pressure(T); };
  auto solver = solver_of(mat, k);
  const std::array<double, 3> times{1, 2, 4};
  for (std::size_t i = 0; i < 3; ++i) {
    march(solver, times[i], p.step, [&](double) { return uniform(mat, mat.thickness, {}); });
    const double left = amplitude(p.cells, [&](int cell) { return solver.cell(cell).y; }) / .1;
    EXPECT_NEAR(left, p.amplitude[i], 5e-5) << times[i];
    const double exact = std::exp(-std::pow(std::numbers::pi / kLength, 2) * 1e-6 * times[i] / .5);
    // The wave is an eigenvector of the cells' equations too: pi/L becomes (2 N/L) sin(pi/(2 N)).
    const double wave_number = 2 * p.cells / kLength * std::sin(std::numbers::pi / (2 * p.cells));
    EXPECT_NEAR(left, std::exp(-wave_number * wave_number * 1e-6 * times[i] / .5), 2e-5) << times[i];
    if (i == 2)
      report("diffusion, amplitude at 4 s over the exact one, less 1, cells: " + std::to_string(p.cells),
             left / exact - 1, p.cells == 20 ? "0.0045" : "5e-4");
  }
  EXPECT_LT(worst_balance(solver), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Cells, BinaryDiffusion,
                         testing::Values(Decay{20, .05, {.57857, .33474, .11205}},
                                         Decay{80, .05, {.57798, .33406, .11159}}));

class SorbedSteam : public testing::TestWithParam<Decay> {};

// Steam alone at 120 C, h = M/.25: linear theory D = (K/mu) p M_w/(R T)/(rho_d .25/p_sat + eps M_w/(R T)).
TEST_P(SorbedSteam, AmplitudeOfAWave) {
  const auto& p = GetParam();
  const auto k = isothermal(1e-14);
  HalfMat mat{p.cells};
  mat.T = 120;
  mat.M_at = [](double depth) { return .1 + .001 * wave(depth); };
  mat.p_a_at = [](double) { return 0.; };
  auto solver = solver_of(mat, k);
  const double vapour = kMolarMassWater / (kGasConstant * 393.15), saturated = saturation_pressure(120.);
  const double D = 1e-14 / k.viscosity * .4 * saturated * vapour / (640 * .25 / saturated + .5 * vapour);
  EXPECT_NEAR(D, 4.16875e-7, 1e-12);
  const std::array<double, 3> times{4, 8, 20};
  for (std::size_t i = 0; i < 3; ++i) {
    march(solver, times[i], p.step, [&](double) { return uniform(mat, mat.thickness, {}); });
    const double left = amplitude(p.cells, [&](int cell) { return solver.state()[cell].M; }) / .001;
    EXPECT_NEAR(left, p.amplitude[i], 1.2e-5) << times[i];
    const double exact = std::exp(-std::pow(std::numbers::pi / kLength, 2) * D * times[i]);
    if (i == 2)
      report("vapour flow, amplitude at 20 s over the exact one, less 1, cells: " + std::to_string(p.cells),
             left / exact - 1, "0.005 with 20 cells");
  }
  EXPECT_LT(worst_balance(solver), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Cells, SorbedSteam,
                         testing::Values(Decay{20, .2, {.63367, .40154, .10217}},
                                         Decay{40, .2, {.63323, .40098, .10181}},
                                         Decay{80, .2, {.63312, .40084, .10173}}));

struct Levelling {
  int cells;
  double step;
  std::array<std::array<double, 3>, 3> rows;  // M of both end cells in %, pressure in kPa at 300, 600, 1200 s
};

class Sorption : public testing::TestWithParam<Levelling> {};

// Half the mat at 10 %, half at 5 %, 100 C: moisture levels out. Numbers of an independent program with the same
// scheme.
TEST_P(Sorption, MoistureLevelsOut) {
  const auto& p = GetParam();
  Constants k;
  k.wood_heat = 1e12;
  k.panel_width = kInfinite;
  HalfMat mat{p.cells};
  mat.T = 100;
  mat.M_at = [](double depth) { return depth > .5 ? .10 : .05; };
  auto solver = solver_of(mat, k);
  const std::array<double, 3> times{300, 600, 1200};
  for (std::size_t i = 0; i < 3; ++i) {
    march(solver, times[i], p.step, [&](double) { return uniform(mat, mat.thickness, {}); });
    EXPECT_NEAR(100 * solver.state().front().M, p.rows[i][0], 6e-5);
    EXPECT_NEAR(100 * solver.state().back().M, p.rows[i][1], 6e-5);
    EXPECT_NEAR(1e-3 * solver.cell(0).p, p.rows[i][2], 6e-3);
  }
  EXPECT_LT(worst_balance(solver), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(
    Cells, Sorption,
    testing::Values(Levelling{20, 10, {{{8.3173, 6.6606, 104.44}, {7.7235, 7.2720, 104.60}, {7.5155, 7.4814, 104.61}}}},
                    Levelling{
                        80, 2.5, {{{8.3368, 6.6402, 104.43}, {7.7296, 7.2658, 104.60}, {7.5159, 7.4810, 104.61}}}}));

}  // namespace
}  // namespace strandlab::transfer
