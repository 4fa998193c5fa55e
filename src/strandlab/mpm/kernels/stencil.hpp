// Weights, gradients and records of the nodes around eight points.
#pragma once

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

// Bardenhagen & Kober (2004): the mean of a hat function over the particle's domain, half-width r cells, at distance d
// from the nearest node. Over the right neighbour's hat max(xi, 0) the mean on [d - r, d + r] is (u1^2 - u0^2)/(4r).
STRANDLAB_INLINE void gimp_axis(const Pack& d, const Pack& r, double inverse_cell, double (&w)[3][kBlock],
                                double (&g)[3][kBlock]) {
  const Pack zero{};
  const Pack half_over_r = 0.5 / r;
  const Pack u1 = larger(d + r, zero), u0 = larger(d - r, zero);
  const Pack l1 = larger(r - d, zero), l0 = larger(-d - r, zero);
  const Pack gr = (u1 - u0) * half_over_r;
  const Pack gl = (l1 - l0) * half_over_r;
  const Pack wr = 0.5 * gr * (u1 + u0);
  const Pack wl = 0.5 * gl * (l1 + l0);
  store(w[0], wl);
  store(w[1], 1.0 - wl - wr);
  store(w[2], wr);
  store(g[0], -gl * inverse_cell);
  store(g[1], (gl - gr) * inverse_cell);
  store(g[2], gr * inverse_cell);
}

// The domain's half-width along an axis is that of the edge that reaches furthest along it: the diagonal of F alone
// would shrink the domain of a particle that has turned far to a point, and a point that passes a node leaves it with a
// force and hardly any mass.
template <int Dim>
STRANDLAB_INLINE void stencil_at(const Pack (&x)[Dim], const Pack (&F)[Dim * Dim], const double* half_size,
                                 const Frame<Dim>& frame, Stencil<Dim>& s) {
  for (int a = 0; a < Dim; ++a) {
    const Pack xi = (x[a] - frame.origin[a]) * frame.inverse_cell[a];
    const Pack rounded = shifted(xi);
    const Mask node = bits(rounded);
    __builtin_memcpy(s.node[a], &node, sizeof node);
    Pack r = splat(1e-3);
    for (int b = 0; b < Dim; ++b) r = larger(absolute(F[a * Dim + b]) * (half_size[b] * frame.inverse_cell[a]), r);
    r = smaller(r, splat(0.5));
    gimp_axis(xi - (rounded - kRounder), r, frame.inverse_cell[a], s.w[a], s.g[a]);
  }
}

// Records of the first row of a lane's stencil on each of its 3 (2D) or 9 (3D) pencils.
template <int Dim>
STRANDLAB_INLINE void pencil_records(const Window& window, const Stencil<Dim>& s, int lane,
                                     int (&record)[Dim == 2 ? 3 : 9]) {
  const int row = static_cast<int>(s.node[Dim - 1][lane]) - 1;
  const int c0 = static_cast<int>(s.node[0][lane]) - 1 - window.first[0];
  if constexpr (Dim == 2) {
    for (int i = 0; i < 3; ++i) record[i] = window.base[c0 + i] + row;
  } else {
    const int c1 = static_cast<int>(s.node[1][lane]) - 1 - window.first[1];
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) record[3 * k + i] = window.base[(c1 + k) * window.count[0] + c0 + i] + row;
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
