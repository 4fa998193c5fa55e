// One block of material points with faces, and the materials that the single-body tests are made of.
#pragma once

#include <cmath>

#include "strandlab/mpm/engine.hpp"
#include "support/strands.hpp"

namespace strandlab::mpm {

// Isotropic, elastic: it would yield at 1 TPa.
inline wood::StrandMaterial isotropic(double E, double nu, double density_kg_m3) {
  wood::Material m;
  m.name = "isotropic";
  m.density_kg_m3 = density_kg_m3;
  m.E_L = m.E_R = m.E_T = E;
  m.G_RL = m.G_TL = m.G_RT = E / (2 * (1 + nu));
  m.nu_RL = m.nu_TL = m.nu_TR = nu;
  m.hill.Y_R = m.hill.Y_T = m.hill.S_RT = 1e6;
  return wood::in_strand_axes(m, 0);
}

// Poplar that does not yield, its grain at an angle to the section.
inline wood::StrandMaterial elastic_poplar(double angle_deg) {
  wood::Material m = wood::library()[0];
  m.hill.Y_R = m.hill.Y_T = m.hill.S_RT = 1e6;
  return wood::in_strand_axes(m, angle_deg);
}

// A box with its lowest corner at `corner`, filled by points[a] particles on each axis.
template <int Dim>
Body<Dim> block(const wood::StrandMaterial& material, const std::array<int, Dim>& points, const Vec<Dim>& spacing,
                const Vec<Dim>& corner) {
  auto s = test::strand_from<Dim>(material, corner, spacing, points);
  s.kind = "test";
  return body_of(s);
}

// A grid of equal cells with a line through 0 and a wide window, free on all sides.
template <int Dim>
Grid<Dim> open_grid(double cell, double lo, double hi) {
  Grid<Dim> g;
  g.cell = Vec<Dim>::Constant(cell);
  g.origin = Vec<Dim>::Zero();
  g.lo = Vec<Dim>::Constant(lo);
  g.hi = Vec<Dim>::Constant(hi);
  return g;
}

}  // namespace strandlab::mpm
