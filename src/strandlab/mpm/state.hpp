// What the engine keeps besides its bodies: with them it goes on to the same bits, and a checkpoint holds nothing else
// of it.
#pragma once

#include <concepts>
#include <tuple>
#include <type_traits>

namespace strandlab::mpm {

// Rigid plane normal to the last axis. Moves with `velocity`.
struct Platen {
  double position = 0;  // mm
  double velocity = 0;  // mm/s
};

// Running totals, mJ (2D: per mm depth). Each from its own definition.
struct Energies {
  double kinetic = 0;   // of the particles, now
  double elastic = 0;   // stored, now
  double plastic = 0;   // dissipated: sum V0 tau : d eps_p
  double friction = 0;  // dissipated by slip against friction
  double contact = 0;   // lost in inelastic meetings (normal impulses)
  // Lost in the algorithm, not in the wood. Three parts: the kinetic energy that the velocity filter takes; that of the
  // changes of velocity, 1/2 sum m |dv|^2, which is larger on the grid than on the particles that take them up; and the
  // difference of the work of forces, on the mean velocity of a step, and of stresses, on its last.
  double filter = 0;
  double softening = 0;      // lost as wood under stress gets softer, or stiffer (Engine::soften)
  double damping = 0;        // taken by Engine::scale_velocities
  double platen_work = 0;    // done by the platens on the bodies
  double external_work = 0;  // done by tractions and gravity
};

struct EngineState {
  long long step = 0;
  double time_s = 0;
  double time_step_s = 0;
  Platen bottom, top;
  // Totals. The engine leaves kinetic and elastic alone, since they follow from the bodies: a checkpoint holds them as
  // energies() gave them.
  Energies energies;
  // Nodes of several pairs, over all steps, whose velocities the last pass of contact still changed by a hundredth of
  // the first pass's change.
  long long unconverged_contacts = 0;
  int most_fields = 0;      // that met at a node so far, where any did
  double cell_stretch = 1;  // of the cells' height against Grid::cell, where it follows the strands
};

// The members, for core/members.hpp.
template <class S>
requires std::same_as<std::remove_const_t<S>, Platen>
auto members(S& platen) {
  auto& [position, velocity] = platen;
  return std::tie(position, velocity);
}
template <class S>
requires std::same_as<std::remove_const_t<S>, Energies>
auto members(S& energies) {
  auto& [kinetic, elastic, plastic, friction, contact, filter, softening, damping, platen_work, external_work] =
      energies;
  return std::tie(kinetic, elastic, plastic, friction, contact, filter, softening, damping, platen_work, external_work);
}
template <class S>
requires std::same_as<std::remove_const_t<S>, EngineState>
auto members(S& state) {
  auto& [step, time_s, time_step_s, bottom, top, energies, unconverged_contacts, most_fields, cell_stretch] = state;
  return std::tie(step, time_s, time_step_s, bottom, top, energies, unconverged_contacts, most_fields, cell_stretch);
}

}  // namespace strandlab::mpm
