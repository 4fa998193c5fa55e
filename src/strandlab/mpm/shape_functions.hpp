// Grid functions of one point, for the few places outside the kernels that need them.
#pragma once

#include <algorithm>
#include <array>

#include "strandlab/mpm/windows.hpp"

namespace strandlab::mpm {

// GIMP shape functions of one axis for a particle at offset d cells from its central node, half-width r cells
// (|d| <= 1/2, 0 < r <= 1/2): weights of nodes -1, 0, +1 and their derivatives per cell. Bardenhagen & Kober (2004).
struct Gimp3 {
  std::array<double, 3> w, g;
};
inline Gimp3 gimp(double d, double r) {
  const double u1 = std::max(d + r, 0.0), u0 = std::max(d - r, 0.0);
  const double l1 = std::max(r - d, 0.0), l0 = std::max(-d - r, 0.0);
  const double wr = (u1 * u1 - u0 * u0) / (4 * r), wl = (l1 * l1 - l0 * l0) / (4 * r);
  const double gr = (u1 - u0) / (2 * r), gl = (l1 - l0) / (2 * r);
  return {{wl, 1 - wl - wr, wr}, {-gl, gl - gr, gr}};
}

// Weights of the nodes around a point: -1, 0 and +1 of the nearest on each axis.
template <int Dim>
struct PointStencil {
  std::array<int, Dim> node;
  std::array<Gimp3, Dim> axis;
};

// Calls visit(record, weight) for the nodes of a stencil.
template <int Dim, class Visit>
void each_node(const WindowStore& w, const PointStencil<Dim>& s, Visit visit) {
  for (int q = 0; q < (Dim == 2 ? 3 : 9); ++q) {
    const int i = q % 3, k = q / 3;
    const int column = s.node[0] - 1 + i - w.window.first[0];
    const int across = Dim == 2 ? 0 : s.node[Dim - 2] - 1 + k - w.window.first[1];
    const double weight = s.axis[0].w[i] * (Dim == 2 ? 1.0 : s.axis[Dim - 2].w[k]);
    if (weight == 0) continue;  // the window may end here
    const int base = w.base[across * w.window.count[0] + column] + s.node[Dim - 1] - 1;
    for (int j = 0; j < 3; ++j) visit(static_cast<std::size_t>(base + j), weight * s.axis[Dim - 1].w[j]);
  }
}

}  // namespace strandlab::mpm
