// Properties of wood, steam and air against tables made from the exact formulas by an independent program.
#include "strandlab/transfer/properties.hpp"

#include <gtest/gtest.h>

#include <array>

#include "strandlab/core/error.hpp"
#include "strandlab/transfer/balance.hpp"

namespace strandlab::transfer {
namespace {

const Constants k;

// Verification values of IAPWS-IF97, Table 35, at 300, 500, 600 K; and values in degrees Celsius.
TEST(Properties, SaturationPressure) {
  EXPECT_NEAR(saturation_pressure(300 - kZeroCelsius), 3536.589, 1e-3);
  EXPECT_NEAR(saturation_pressure(500 - kZeroCelsius), 2638898, 1);
  EXPECT_NEAR(saturation_pressure(600 - kZeroCelsius), 12344315, 1);
  const std::array<double, 7> T{20, 60, 100, 120, 150, 180, 200};
  const std::array<double, 7> p{2339.2, 19945.8, 101418.0, 198665.4, 476101.4, 1002634.6, 1554671.9};
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(saturation_pressure(T[i]), p[i], .06) << T[i];
}

TEST(Properties, SorptionIsotherm) {
  const std::array<double, 6> T{20, 60, 100, 120, 150, 180};
  const std::array<std::pair<double, std::array<double, 6>>, 5> rows{
      {{.01, {.0326, .0501, .0719, .0848, .1079, .1382}},
       {.05, {.2202, .3148, .4292, .4953, .6066, .7319}},
       {.08, {.4036, .5298, .6629, .7301, .8273, .9121}},
       {.12, {.6307, .7499, .8534, .8968, .9486, .9818}},
       {.20, {.8877, .9426, .9767, .9870, .9959, .9993}}}};
  for (const auto& [M, h] : rows) {
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(relative_pressure(k, T[i], M), h[i], 6e-5) << M << " " << T[i];
  }
  EXPECT_DOUBLE_EQ(relative_pressure(k, 100., 0.), 0);
}

TEST(Properties, MoistureInSteamOfOneAtmosphere) {
  const std::array<double, 8> T{105, 110, 120, 130, 140, 150, 160, 180};
  const std::array<double, 8> M{11.198, 8.163, 5.157, 3.516, 2.486, 1.804, 1.336, .768};
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(100 * equilibrium_moisture(k, T[i], 101325), M[i], 6e-4) << T[i];
  EXPECT_THROW(equilibrium_moisture(k, 90, 101325), InputError);  // steam of one atmosphere would condense
}

TEST(Properties, EnergyOfMoistWood) {
  EXPECT_NEAR(wood_energy(k, 100., .08), 122207.95, .006);
  EXPECT_NEAR(wood_energy(k, 100., 0.), 135275.00, .006);
  EXPECT_NEAR(wood_energy(k, 20., .05), -7024.16, .006);
}

// Heat of evaporation and sorption that follows: h_v - dE_w/dM = L0 - (c_l - c_v) T + h_s0 exp(-b M).
TEST(Properties, HeatOfDesorption) {
  const auto M = Dual<1>::unknown(.05, 0);
  const double slope = wood_energy(k, Dual<1>(100.), M).d[0];
  EXPECT_NEAR(vapour_enthalpy(k, 100.) - slope, 2.501e6 - (4190 - 1880) * 100 + 1e6 * std::exp(-15 * .05), 1e-6);
}

TEST(Properties, MatAtFourDensities) {
  const std::array<double, 4> density{350, 450, 640, 900};
  const std::array<double, 4> conductivities{.09795, .12062, .16367, .22259};
  const std::array<double, 4> permeabilities{1.1454e-11, 2.1827e-12, 9.3634e-14, 1.3559e-15};
  const std::array<double, 4> pores{.7387, .6640, .5221, .3280};
  const std::array<double, 4> diffusivities{1.4221e-6, 1.2783e-6, 1.0052e-6, 6.3147e-7};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(conductivity(k, density[i], .08), conductivities[i], 6e-6);
    EXPECT_NEAR(permeability(k, density[i]) / permeabilities[i], 1, 6e-5);
    EXPECT_NEAR(porosity(k, density[i], .08), pores[i], 6e-5);
    EXPECT_NEAR(diffusivity(k, porosity(k, density[i], .08), 100., 1e5) / diffusivities[i], 1, 6e-5);
  }
  EXPECT_DOUBLE_EQ(porosity(k, 1600, .08), k.porosity_floor);
}

TEST(Properties, PermeabilityFromATable) {
  Constants table;
  table.permeabilities = {{400, 1e-12}, {600, 1e-14}};
  EXPECT_NEAR(permeability(table, 500), 1e-13, 1e-18);
  EXPECT_DOUBLE_EQ(permeability(table, 300), 1e-12);
  EXPECT_DOUBLE_EQ(permeability(table, 600), 1e-14);
  EXPECT_DOUBLE_EQ(permeability(table, 900), 1e-14);
}

// Derivatives against differences, for a cell and for the flux between two.
TEST(Balance, DerivativesOfACell) {
  using D = Dual<3>;
  const std::array<double, 3> at{110, .06, 3e4}, step{1e-3, 1e-6, 1};
  const auto holds = [&](const std::array<double, 3>& x) {
    return cell_at<double>(k, .3, .0005, x[0], x[1], x[2]).holds;
  };
  const auto exact = cell_at<D>(k, .3, .0005, D::unknown(at[0], 0), D::unknown(at[1], 1), D::unknown(at[2], 2)).holds;
  for (std::size_t j = 0; j < 3; ++j) {
    auto low = at, high = at;
    low[j] -= step[j];
    high[j] += step[j];
    const auto before = holds(low), after = holds(high);
    for (std::size_t row = 0; row < 3; ++row) {
      const double difference = (after[row] - before[row]) / (2 * step[j]);
      EXPECT_NEAR(exact[row].d[j], difference, 1e-6 * std::abs(difference) + 1e-15) << row << " by " << j;
    }
  }
}

TEST(Balance, DerivativesOfAFace) {
  using D = Dual<6>;
  const std::array<double, 6> at{130, .03, 2e3, 110, .08, 3e3}, step{1e-3, 1e-6, 1, 1e-3, 1e-6, 1};
  const auto flux = [&](const auto& x) {
    using S = std::decay_t<decltype(x[0])>;
    const auto a = cell_at<S>(k, .3, .0005, x[0], x[1], x[2]), b = cell_at<S>(k, .3, .0006, x[3], x[4], x[5]);
    return face_flux(k, side_of(k, a, .00025, false), side_of(k, b, .0003, false));
  };
  std::array<D, 6> unknowns;
  for (int j = 0; j < 6; ++j) unknowns[j] = D::unknown(at[j], j);
  const auto exact = flux(unknowns);
  for (std::size_t j = 0; j < 6; ++j) {
    auto low = at, high = at;
    low[j] -= step[j];
    high[j] += step[j];
    const auto before = flux(low), after = flux(high);
    for (std::size_t row = 0; row < 3; ++row) {
      const double difference = (after[row] - before[row]) / (2 * step[j]);
      EXPECT_NEAR(exact[row].d[j], difference, 1e-5 * std::abs(difference) + 1e-12) << row << " by " << j;
    }
  }
}

// What leaves one cell arrives in the other, whichever is named first.
TEST(Balance, FluxesAreOpposite) {
  const auto a = cell_at<double>(k, .3, .0005, 130, .03, 2e3), b = cell_at<double>(k, .3, .0006, 110, .08, 3e3);
  const auto sa = side_of(k, a, .00025, false), sb = side_of(k, b, .0003, false);
  const auto there = face_flux(k, sa, sb), back = face_flux(k, sb, sa);
  for (int row = 0; row < 3; ++row) EXPECT_NEAR(there[row], -back[row], 1e-12 * std::abs(there[row]));
}

}  // namespace
}  // namespace strandlab::transfer
