// Weights, gradients and records of the nodes around eight points.
#pragma once

#include "strandlab/mpm/gimp.hpp"
#include "strandlab/mpm/kernels.hpp"
#include "strandlab/mpm/kernels/pack.hpp"

namespace strandlab::mpm::STRANDLAB_ISA {
namespace {

// GIMP weights and gradients of eight particles: three nodes per axis around the nearest node.
template <int Dim>
struct Stencil {
  alignas(64) double w[Dim][3][kBlock];
  alignas(64) double g[Dim][3][kBlock];  // 1/mm
  alignas(64) long long node[Dim][kBlock];
};

STRANDLAB_INLINE void store_axis(const Gimp<Pack>& axis, double inverse_cell, double (&w)[3][kBlock],
                                 double (&g)[3][kBlock]) {
  for (int k = 0; k < 3; ++k) {
    store(w[k], axis.weight[k]);
    store(g[k], axis.gradient[k] * inverse_cell);
  }
}

// The domain's half-width along an axis is that of the edge that reaches furthest along it: the diagonal of F alone
// would shrink the domain of a particle that has turned far to a point, and a point that passes a node leaves it with a
// force and hardly any mass.
template <int Dim>
STRANDLAB_INLINE void stencil_at(const Pack (&x)[Dim], const Pack (&F)[Dim * Dim], const double* half_size,
                                 const Step<Dim>& step, Stencil<Dim>& s) {
  for (int a = 0; a < Dim; ++a) {
    const Pack xi = (x[a] - step.origin[a]) * step.inverse_cell[a];
    const Pack rounded = shifted(xi);
    const Mask node = bits(rounded);
    __builtin_memcpy(s.node[a], &node, sizeof node);
    Pack r = splat(kLeastHalfWidth);
    for (int b = 0; b < Dim; ++b) r = larger(absolute(F[a * Dim + b]) * (half_size[b] * step.inverse_cell[a]), r);
    r = smaller(r, splat(kMostHalfWidth));
    store_axis(gimp<Pack>(xi - (rounded - kRounder), r), step.inverse_cell[a], s.w[a], s.g[a]);
  }
}

// Records of the first row of a lane's stencil on each of its 3 (2D) or 9 (3D) pencils.
template <int Dim>
STRANDLAB_INLINE void pencil_records(const Patch& patch, const Stencil<Dim>& s, int lane,
                                     int (&record)[Dim == 2 ? 3 : 9]) {
  const int row = static_cast<int>(s.node[Dim - 1][lane]) - 1;
  const int c0 = static_cast<int>(s.node[0][lane]) - 1 - patch.first[0];
  if constexpr (Dim == 2) {
    for (int i = 0; i < 3; ++i) record[i] = patch.base[c0 + i] + row;
  } else {
    const int c1 = static_cast<int>(s.node[1][lane]) - 1 - patch.first[1];
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) record[3 * k + i] = patch.base[(c1 + k) * patch.count[0] + c0 + i] + row;
    }
  }
}

// Weight of a pencil for a lane and its lateral gradients.
template <int Dim>
STRANDLAB_INLINE double pencil_weight(const Stencil<Dim>& s, int q, int lane) {
  if constexpr (Dim == 2)
    return s.w[0][q][lane];
  else
    return s.w[0][q % 3][lane] * s.w[1][q / 3][lane];
}
template <int Dim>
STRANDLAB_INLINE double pencil_gradient(const Stencil<Dim>& s, int axis, int q, int lane) {
  if constexpr (Dim == 2)
    return s.g[0][q][lane];
  else
    return axis == 0 ? s.g[0][q % 3][lane] * s.w[1][q / 3][lane] : s.w[0][q % 3][lane] * s.g[1][q / 3][lane];
}
template <int Dim>
inline constexpr int kPencils = Dim == 2 ? 3 : 9;

}  // namespace
}  // namespace strandlab::mpm::STRANDLAB_ISA
