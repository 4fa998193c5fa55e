// Properties of wood, steam and air in a mat that is pressed hot: one function per quantity, with its formula and
// source.
//
// SI units in this room: m, s, kg, Pa (absolute), J, W, mol; temperatures in degrees Celsius, T_K = T + 273.15;
// moisture content M in kg of water per kg of oven-dry wood; dry density rho_d in kg of oven-dry wood per m^3 of mat.
//
// Functions of temperature and moisture are templates on their type: numbers, or duals that carry derivatives.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "strandlab/transfer/dual.hpp"

namespace strandlab::transfer {

inline constexpr double kGasConstant = 8.314462618;   // J/(mol K), CODATA 2018
inline constexpr double kMolarMassWater = .01801528;  // kg/mol
inline constexpr double kMolarMassAir = .0289652;     // kg/mol
inline constexpr double kZeroCelsius = 273.15;        // K

struct PermeabilityPoint {
  double density, permeability;  // kg/m^3, m^2
};

// Constants with the defaults of a strand mat. "judgement": no measured value was at hand; calibrate
// (docs/hotpress.md).
struct Constants {
  // Sorption isotherm (relative_pressure).
  double isotherm_limit = .2797, isotherm_limit_slope = .003615;  // M0 at 20 C, its fall per K
  double isotherm_steepness = 4.732;                              // -
  double isotherm_onset = .01;                                    // M below which the isotherm goes to zero
  double linear_isotherm = 0;                                     // > 0: h = M/this, which closed forms need
  // Heat.
  double wood_heat = 1159.4, wood_heat_slope = 3.867;         // J/(kg K), J/(kg K^2): c = c0 + c1 T
  double water_heat = 4190, vapour_heat = 1880;               // J/(kg K), steam tables
  double air_heat = 1006;                                     // J/(kg K)
  double latent_heat = 2.501e6;                               // J/kg at 0 C, steam tables
  double sorption_heat = 1e6, sorption_heat_decay = 15;       // J/kg at M = 0; per unit of M
  double conductivity_dry = .1941, conductivity_wet = .4064;  // W/(m K) per t/m^3 of dry wood; the same per unit of M
  double conductivity_air = .01864;                           // W/(m K)
  double conductivity_in_plane = 2;                           // over that through the thickness; judgement
  // Gas.
  double permeability_400 = 5e-12, permeability_slope = .0072, permeability_floor = 1e-16;  // m^2, judgement
  double permeability_in_plane = 30;              // over that through the thickness; judgement
  std::vector<PermeabilityPoint> permeabilities;  // by increasing density; not empty: in place of the formula
  double viscosity = 1.3e-5;                      // Pa s, steam at 110 C
  double diffusion_factor = .05;                  // -, judgement: a vapour resistance factor of 40 at 640 kg/m^3
  double cell_wall_density = 1500;                // kg/m^3
  double porosity_floor = .05;                    // -
  // Panel and room.
  double panel_width = .6;  // m, the shorter way; inf: edges closed
  double ambient_temperature = 20, ambient_humidity = .5, ambient_pressure = 101325;  // C, -, Pa
};

// Saturation pressure of water, Pa: IAPWS-IF97, region 4 (Wagner et al. 2000, Eq. 30).
template <class S>
S saturation_pressure(const S& T) {
  using std::sqrt;
  constexpr double n1 = 0.11670521452767e4, n2 = -0.72421316703206e6, n3 = -0.17073846940092e2, n4 = 0.12020824702470e5,
                   n5 = -0.32325550322333e7, n6 = 0.14915108613530e2, n7 = -0.48232657361591e4, n8 = 0.40511340542057e6,
                   n9 = -0.23855557567849, n10 = 0.65017534844798e3;
  const S kelvin = T + kZeroCelsius;
  const S theta = kelvin + n9 / (kelvin - n10);
  const S a = theta * theta + n1 * theta + n2;
  const S b = n3 * (theta * theta) + n4 * theta + n5;
  const S c = n6 * (theta * theta) + n7 * theta + n8;
  const S root = 2.0 * c / (sqrt(b * b - 4.0 * a * c) - b);
  const S square = root * root;
  return 1e6 * (square * square);
}

// Relative vapour pressure h of wood at moisture content M: Nelson's form, fitted to the isotherm of the Wood Handbook
// (FPL-GTR-190, Table 4-2) between 20 and 100 C; the last factor takes it to zero with M.
//   h = exp(-(M_w/(R T_K)) exp(A (1 - M/M0(T)))) (1 - exp(-M/M_on)),  M_w/R = 18.01528/1.9872
template <class S>
S relative_pressure(const Constants& k, const S& T, const S& M) {
  using std::exp;
  if (k.linear_isotherm > 0) return M / k.linear_isotherm;
  const S limit = k.isotherm_limit * (1.0 - k.isotherm_limit_slope * (T - 20.0));
  const S free_energy = exp(k.isotherm_steepness * (1.0 - M / limit));
  return exp(-(18.01528 / 1.9872) / (T + kZeroCelsius) * free_energy) * (1.0 - exp(-M / k.isotherm_onset));
}

// Moisture content at which wood is in balance with vapour of pressure p_v (Pa): the inverse of relative_pressure.
// Throws InputError where no M up to `at_most` is.
double equilibrium_moisture(const Constants& k, double T, double vapour_pressure, double at_most = .3);

// Energy of wood and the water in it, J per kg of oven-dry wood, zero for dry wood at 0 C: heat capacities of wood
// (Wood Handbook, Eq. 4-16a) and water, less the heat of sorption h_s0 exp(-b M) given off up to M.
template <class S>
S wood_energy(const Constants& k, const S& T, const S& M) {
  using std::exp;
  const S sorbed = (k.sorption_heat / k.sorption_heat_decay) * (1.0 - exp(-k.sorption_heat_decay * M));
  return k.wood_heat * T + (0.5 * k.wood_heat_slope) * (T * T) + k.water_heat * (M * T) - sorbed;
}

// Enthalpies of vapour and air, J/kg, zero for liquid water and air at 0 C.
template <class S>
S vapour_enthalpy(const Constants& k, const S& T) {
  return k.latent_heat + k.vapour_heat * T;
}
template <class S>
S air_enthalpy(const Constants& k, const S& T) {
  return k.air_heat * T;
}

// Thermal conductivity through the thickness, W/(m K): Wood Handbook, Eq. 4-15.
template <class S>
S conductivity(const Constants& k, double dry_density, const S& M) {
  return (1e-3 * dry_density) * (k.conductivity_dry + k.conductivity_wet * M) + k.conductivity_air;
}

// Part of the mat's volume that is gas: 1 - rho_d (1/rho_wall + M/rho_water), not below a floor.
template <class S>
S porosity(const Constants& k, double dry_density, const S& M) {
  const S pores = 1.0 - dry_density * (1 / k.cell_wall_density + 1e-3 * M);
  return value_of(pores) > k.porosity_floor ? pores : S(k.porosity_floor);
}

// Permeability of the mat to gas through the thickness, m^2: falls by a power of ten every 139 kg/m^3; or the table,
// straight between its points in log K, constant beyond.
double permeability(const Constants& k, double dry_density);

// Effective diffusivity of vapour in the mat, m^2/s: that in free air, 2.6e-5 (T_K/298.15)^1.75 (1e5/p), through the
// pores with a factor for their ways.
template <class S>
S diffusivity(const Constants& k, const S& pores, const S& T, const S& p) {
  using std::pow;
  return (k.diffusion_factor * 2.6e-5 * 1e5) * pores * pow((T + kZeroCelsius) / 298.15, 1.75) / p;
}

}  // namespace strandlab::transfer
