// Balances of water, air and energy of the cells of a mat, as templates on the scalar type: the same lines give
// values, derivatives and what the tests look at. Units as in properties.hpp.
//
// A cell is a layer of constant dry mass m (kg per m^2 of panel) whose thickness changes: wood, its heat and its water
// stay with the cell, gas flows through its faces. It holds, per m^2 of panel,
//   water   m M + D eps rho_v                      J = M_w N_v through a face
//   air     D eps rho_a                            J = M_a N_a
//   energy  m E_w(T, M) + D eps (rho_v h_v + rho_a h_a)    q + J_v h_v + J_a h_a
// with local sorption equilibrium, p_v = h(T, M) p_sat(T). Evaporation is no term of its own: it moves water from wood
// to gas at a constant total. Humphrey & Bolton (1989), Zombori, Kamke & Watson (2003) and Kavazovic et al. (2011) have
// models of this kind.
#pragma once

#include <array>

#include "strandlab/transfer/properties.hpp"

namespace strandlab::transfer {

// What a cell holds or passes, per m^2.
enum Row { kWater = 0, kAir = 1, kEnergy = 2 };  // kg, kg, J; fluxes: kg/s, kg/s, W

// A cell's contents and properties at its unknowns T, M, p_a.
template <class S>
struct Cell {
  S T, p, y, c;                     // C, Pa, vapour's part of the gas (mol/mol), mol of gas per m^3 of pores
  S conductivity, diffusion;        // W/(m K); D_e c, mol/(m s)
  S vapour_enthalpy, air_enthalpy;  // J/kg
  double permeability = 0;          // m^2, through the thickness
  std::array<S, 3> holds;           // by Row
};

template <class S>
Cell<S> cell_at(const Constants& k, double dry_mass, double thickness, const S& T, const S& M, const S& p_a) {
  Cell<S> cell;
  const double dry_density = dry_mass / thickness;
  const S p_v = relative_pressure(k, T, M) * saturation_pressure(T);
  const S RT = kGasConstant * (T + kZeroCelsius);
  cell.T = T;
  cell.p = p_a + p_v;
  cell.y = p_v / cell.p;
  cell.c = cell.p / RT;
  const S pores = porosity(k, dry_density, M);
  cell.conductivity = conductivity(k, dry_density, M);
  cell.diffusion = diffusivity(k, pores, T, cell.p) * cell.c;
  cell.vapour_enthalpy = vapour_enthalpy(k, T);
  cell.air_enthalpy = air_enthalpy(k, T);
  cell.permeability = permeability(k, dry_density);
  const S gas = thickness * pores / RT;  // mol/Pa in the pores
  const S vapour = kMolarMassWater * gas * p_v, air = kMolarMassAir * gas * p_a;
  cell.holds[kWater] = dry_mass * M + vapour;
  cell.holds[kAir] = air;
  cell.holds[kEnergy] = dry_mass * wood_energy(k, T, M) + vapour * cell.vapour_enthalpy + air * cell.air_enthalpy;
  return cell;
}

// One side of a face: a cell seen from it, or the room. Resistances are those of the way from the cell's centre.
template <class S>
struct Side {
  S T, p, y, c, vapour_enthalpy, air_enthalpy;
  S heat, diffusion;  // m^2 K/W, m^2 s/mol
  double flow = 0;    // 1/m: half length over permeability
};

// `in_plane`: the way along the panel, better conducting and more permeable.
template <class S>
Side<S> side_of(const Constants& k, const Cell<S>& cell, double half_length, bool in_plane) {
  const double conducting = in_plane ? k.conductivity_in_plane : 1, passing = in_plane ? k.permeability_in_plane : 1;
  return {cell.T,
          cell.p,
          cell.y,
          cell.c,
          cell.vapour_enthalpy,
          cell.air_enthalpy,
          (half_length / conducting) / cell.conductivity,
          half_length / cell.diffusion,
          half_length / (passing * cell.permeability)};
}

// The room's air at its temperature, pressure and humidity, with a film of heat resistance 1/h_room.
template <class S>
Side<S> room_side(const Constants& k, double T, double p, double relative_humidity, double heat_transfer) {
  const double y = relative_humidity * saturation_pressure(T) / p;
  return {S(T),
          S(p),
          S(y),
          S(p / (kGasConstant * (T + kZeroCelsius))),
          S(vapour_enthalpy(k, T)),
          S(air_enthalpy(k, T)),
          S(1 / heat_transfer),
          S(0.0),
          0};
}

template <class S>
using Flux = std::array<S, 3>;  // by Row, per m^2 of face

// What molar fluxes of vapour and air carry; enthalpies come from where each comes from.
template <class S>
Flux<S> carried(const S& vapour, const S& air, const Side<S>& from, const Side<S>& to) {
  const S water = kMolarMassWater * vapour, dry_air = kMolarMassAir * air;
  const S heat = water * (value_of(vapour) >= 0 ? from.vapour_enthalpy : to.vapour_enthalpy) +
                 dry_air * (value_of(air) >= 0 ? from.air_enthalpy : to.air_enthalpy);
  return {water, dry_air, heat};
}

// From a to b: conduction, Darcy flow of the gas and binary diffusion, the two half ways in series. Gas flows with the
// mean of both concentrations, which makes steady isothermal flow exact in p^2, and with the composition upstream.
template <class S>
Flux<S> face_flux(const Constants& k, const Side<S>& a, const Side<S>& b) {
  const S velocity = (a.p - b.p) / (k.viscosity * (a.flow + b.flow));
  const S moles = velocity * (0.5 * (a.c + b.c));
  const S diffused = (a.y - b.y) / (a.diffusion + b.diffusion);
  const S y = value_of(moles) >= 0 ? a.y : b.y;
  const S vapour = moles * y + diffused;
  const S air = moles * (1.0 - y) - diffused;
  auto flux = carried(vapour, air, a, b);
  flux[kEnergy] = flux[kEnergy] + (a.T - b.T) / (a.heat + b.heat);
  return flux;
}

// Into the cell from a platen at T_p: heat only; 1/h_c is the resistance of the contact.
template <class S>
Flux<S> platen_flux(const Side<S>& cell, double platen_temperature, double contact) {
  return {S(0.0), S(0.0), (platen_temperature - cell.T) / (1 / contact + cell.heat)};
}

// Out of a cell at mid-panel to the panel's edges, per m^2 of panel: the steady flow of gas generated uniformly in a
// strip of width W, whose mid-line has pressure p:
//   moles = 8 D K_xy/(mu W^2) (p - p_amb)(p + p_amb)/(2 R T_K)
template <class S>
Flux<S> edge_flux(const Constants& k, const Cell<S>& cell, double thickness) {
  if (std::isinf(k.panel_width)) return {S(0.0), S(0.0), S(0.0)};
  const double ambient = k.ambient_pressure;
  const auto room = room_side<S>(k, k.ambient_temperature, ambient, k.ambient_humidity, 1);
  const auto inside = side_of(k, cell, 1, true);
  const auto& source = value_of(cell.p) >= ambient ? inside : room;
  const double strip =
      8 * thickness * k.permeability_in_plane * cell.permeability / (k.viscosity * k.panel_width * k.panel_width);
  const S moles = strip * (cell.p - ambient) * (cell.p + ambient) / (2 * kGasConstant * (source.T + kZeroCelsius));
  return carried(S(moles * source.y), S(moles * (1.0 - source.y)), inside, room);
}

}  // namespace strandlab::transfer
