// GIMP shape functions of one axis, for one point (T = double) and for a pack of them.
#pragma once

// Plain arrays and conditional expressions only, so that the same lines compile for each instruction set of the
// kernels.
namespace strandlab::mpm {

// Half-widths of a particle's domain along an axis, cells: a wider one would reach past three nodes, and a thinner one
// has the hat function's own weights to 1/2000 while 1/r stays finite.
inline constexpr double kLeastHalfWidth = 1e-3, kMostHalfWidth = 0.5;

template <class T>
struct Gimp {
  T weight[3];    // of the nodes -1, 0, +1 around the nearest
  T gradient[3];  // per cell
};

// For a particle at offset d cells from its nearest node, half-width r cells (|d| <= 1/2, 0 < r <= 1/2): the mean of a
// node's hat function over the particle's domain, and of its slope (Bardenhagen & Kober 2004). Over the right
// neighbour's hat max(xi, 0) the mean on [d - r, d + r] is (u1^2 - u0^2)/(4r).
template <class T>
[[gnu::always_inline]] inline Gimp<T> gimp(const T& d, const T& r) {
  const T zero{};
  const T right = d + r, right_end = d - r, left = r - d, left_end = -d - r;
  const T u1 = right > zero ? right : zero, u0 = right_end > zero ? right_end : zero;
  const T l1 = left > zero ? left : zero, l0 = left_end > zero ? left_end : zero;
  const T half_over_r = 0.5 / r;
  const T gr = (u1 - u0) * half_over_r;
  const T gl = (l1 - l0) * half_over_r;
  const T wr = 0.5 * gr * (u1 + u0);
  const T wl = 0.5 * gl * (l1 + l0);
  return {{wl, 1.0 - wl - wr, wr}, {-gl, gl - gr, gr}};
}

}  // namespace strandlab::mpm
