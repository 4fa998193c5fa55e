// Heat alone, and heat with evaporation in a sealed mat.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "mats.hpp"
#include "support/report.hpp"

namespace strandlab::transfer {
namespace {

using namespace test;

// Wood that only conducts, rho c = 640 x 1500 J/(m^3 K) and k = 0.15 W/(m K), with next to no gas in it.
Constants conducting() {
  Constants k;
  k.wood_heat = 1500;
  k.wood_heat_slope = 0;
  k.conductivity_dry = k.conductivity_wet = 0;
  k.conductivity_air = .15;
  k.panel_width = kInfinite;
  return k;
}

// Mid-plane of a plate of half thickness L, at T_0, whose faces see T_p through h_c from t = 0 on. Carslaw & Jaeger
// (1959), section 3.11: T = T_p + (T_0 - T_p) sum 4 sin b/(2b + sin 2b) exp(-b^2 a t/L^2), b tan b = h_c L/k.
double plate(double t, double contact) {
  const double L = .006, k = .15, a = k / (640 * 1500.), biot = contact * L / k;
  double sum = 0;
  for (int n = 0; n < 200; ++n) {
    double low = n * std::numbers::pi, high = low + std::numbers::pi / 2;
    for (int i = 0; i < 200; ++i) {
      const double b = .5 * (low + high);
      (b * std::abs(std::sin(b)) < biot * std::abs(std::cos(b)) ? low : high) = b;
    }
    const double b = std::isinf(biot) ? (n + .5) * std::numbers::pi : low;
    sum += 4 * std::sin(b) / (2 * b + std::sin(2 * b)) * std::exp(-b * b * a * t / (L * L));
  }
  return 200 + (20 - 200) * sum;
}

// The mid-plane by a parabola through the two cells next to it.
double mid_plane(const Solver& solver) {
  const double T1 = solver.state()[0].T, T2 = solver.state()[1].T;
  return T1 + (T1 - T2) / 8;
}

struct Plate {
  double contact;
  std::array<double, 4> exact, coarse, fine;  // mid-plane at 30, 60, 120, 240 s; 20 cells and .5 s, 80 cells and .125 s
};
const std::array<double, 4> kTimes{30, 60, 120, 240};

class Conduction : public testing::TestWithParam<Plate> {};

std::array<double, 4> simulated(int cells, double step, double contact) {
  HalfMat mat{cells};
  mat.M = 0;
  mat.p_a_at = [](double) { return 1e-3; };
  const auto face = platen(200, contact);
  auto solver = solver_of(mat, conducting(), face);
  std::array<double, 4> T{};
  for (std::size_t i = 0; i < 4; ++i) {
    march(solver, kTimes[i], step, [&](double) { return uniform(mat, mat.thickness, face); });
    T[i] = mid_plane(solver);
  }
  EXPECT_LT(worst_balance(solver), 1e-10);
  return T;
}

// Closed form above; an independent program with the same scheme gives the digits for 20 and 80 cells.
TEST_P(Conduction, MidPlaneOfAPlate) {
  const auto& p = GetParam();
  const auto coarse = simulated(20, .5, p.contact), fine = simulated(80, .125, p.contact);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(plate(kTimes[i], p.contact), p.exact[i], 6e-5);
    EXPECT_NEAR(coarse[i], p.coarse[i], 6e-5) << kTimes[i];
    EXPECT_NEAR(fine[i], p.fine[i], 6e-5) << kTimes[i];
  }
  const double ratio = (coarse[1] - p.exact[1]) / (fine[1] - p.exact[1]);
  report(std::string("conduction, ") + (std::isinf(p.contact) ? "perfect contact" : "contact of 500 W/m2K") +
             ": error at 60 s with 20 cells over that with 80",
         ratio, near(16, 2).because("the order is 2 in the limit of many cells"));
}

INSTANTIATE_TEST_SUITE_P(Contact, Conduction,
                         testing::Values(Plate{kInfinite,
                                               {38.0157, 79.6968, 136.6037, 182.4630},
                                               {38.0096, 79.6330, 136.5457, 182.4354},
                                               {38.0153, 79.6928, 136.6001, 182.4613}},
                                         Plate{500,
                                               {34.5772, 72.7788, 128.7607, 177.7967},
                                               {34.5896, 72.7271, 128.7052, 177.7662},
                                               {34.5779, 72.7756, 128.7572, 177.7948}}));

struct Sealed {
  int cells;
  std::array<std::array<double, 6>, 4> rows;  // core T, core M %, core gas kPa, face T, face M %, largest M % at kTimes
  double energy;                              // kJ/m^2 gained
};

class SealedMat : public testing::TestWithParam<Sealed> {};

// A sealed mat of fixed density: water evaporates at the face and condenses at the core. Numbers of an independent
// program, 12 mm, 640 kg/m^3, 8 %, k = .16, K = 1e-13, platens of 180 C with h_c = 1000, steps of .5 s.
TEST_P(SealedMat, EvaporationAndCondensation) {
  const auto& p = GetParam();
  Constants k;
  k.conductivity_dry = k.conductivity_wet = 0;
  k.conductivity_air = .16;
  k.permeability_400 = 0;
  k.permeability_floor = 1e-13;
  k.panel_width = kInfinite;
  const HalfMat mat{p.cells};
  const auto face = platen(180, 1000);
  auto solver = solver_of(mat, k, face);
  const double water = solver.content()[kWater];
  for (std::size_t i = 0; i < 4; ++i) {
    march(solver, kTimes[i], .5, [&](double) { return uniform(mat, mat.thickness, face); });
    const auto &core = solver.state().front(), &skin = solver.state().back();
    double wettest = 0;
    for (const auto& s : solver.state()) wettest = std::max(wettest, s.M);
    const double gas = 1e-3 * (solver.cell(0).p - 101325);
    const std::array<double, 6> row{core.T, 100 * core.M, gas, skin.T, 100 * skin.M, 100 * wettest};
    const std::array<double, 6> digit{1e-3, 1e-4, 1e-3, 1e-3, 1e-4, 1e-3};
    for (std::size_t j = 0; j < 6; ++j) EXPECT_NEAR(row[j], p.rows[i][j], .6 * digit[j]) << kTimes[i] << " s, " << j;
  }
  EXPECT_NEAR(1e-3 * solver.received()[kEnergy], p.energy, .006);
  report("water of the sealed mat after 240 s over that at the start, less 1, cells: " + std::to_string(p.cells),
         solver.content()[kWater] / water - 1, within(1e-12).because(strandlab::test::kRoundOff));
  EXPECT_LT(worst_balance(solver), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Cells, SealedMat,
                         testing::Values(Sealed{20,
                                                {{{36.769, 8.0053, 73.299, 165.431, 1.6294, 13.804},
                                                  {74.179, 8.0520, 130.878, 170.197, 1.7268, 13.696},
                                                  {121.267, 8.3988, 286.721, 174.579, 2.2457, 12.527},
                                                  {156.590, 9.6648, 584.615, 178.112, 3.4905, 10.840}}},
                                                1043.25},
                                         Sealed{40,
                                                {{{36.556, 8.0051, 73.771, 168.976, 1.4969, 14.007},
                                                  {73.895, 8.0501, 131.419, 172.573, 1.6353, 13.922},
                                                  {121.108, 8.3860, 287.297, 175.885, 2.1781, 12.574},
                                                  {156.634, 9.6206, 585.612, 178.566, 3.4482, 10.824}}},
                                                1043.42},
                                         Sealed{80,
                                                {{{36.455, 8.0050, 74.014, 170.741, 1.4371, 14.294},
                                                  {73.750, 8.0494, 131.692, 173.758, 1.5927, 13.956},
                                                  {121.023, 8.3813, 287.559, 176.538, 2.1456, 12.583},
                                                  {156.653, 9.6011, 586.082, 178.794, 3.4275, 10.807}}},
                                                1043.48}));

}  // namespace
}  // namespace strandlab::transfer
