// Strands for tests: boxes of material points at rest.
#pragma once

#include <array>
#include <cmath>

#include "strandlab/panel/panel.hpp"

namespace strandlab::test {

// A strand that fills low..high, mm, with counts[a] points on each axis.
template <int Dim>
Strand<Dim> strand_between(const wood::StrandMaterial& material, const Vec<Dim>& low, const Vec<Dim>& high,
                           const std::array<int, Dim>& counts) {
  Lattice<Dim> lattice;
  lattice.counts = counts;
  for (int a = 0; a < Dim; ++a) lattice.spacing[a] = (high[a] - low[a]) / counts[a];
  return formed_strand<Dim>(lattice, {low}, material);
}

// The same with points about `spacing` mm apart.
template <int Dim>
Strand<Dim> strand_between(const wood::StrandMaterial& material, const Vec<Dim>& low, const Vec<Dim>& high,
                           double spacing) {
  std::array<int, Dim> counts{};
  for (int a = 0; a < Dim; ++a) counts[a] = static_cast<int>(std::lround((high[a] - low[a]) / spacing));
  return strand_between<Dim>(material, low, high, counts);
}

// A strand from its lowest corner (mm) on, points `spacing` mm apart.
template <int Dim>
Strand<Dim> strand_from(const wood::StrandMaterial& material, const Vec<Dim>& corner, const Vec<Dim>& spacing,
                        const std::array<int, Dim>& counts) {
  return formed_strand<Dim>({counts, spacing}, {corner}, material);
}

}  // namespace strandlab::test
