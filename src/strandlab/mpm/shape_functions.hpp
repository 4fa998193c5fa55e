// Grid functions of one point, for the few places outside the kernels that need them.
#pragma once

#include <array>

#include "strandlab/mpm/gimp.hpp"
#include "strandlab/mpm/patches.hpp"

namespace strandlab::mpm {

// Weights of the nodes around a point: -1, 0 and +1 of the nearest on each axis.
template <int Dim>
struct PointStencil {
  std::array<int, Dim> node;
  std::array<Gimp<double>, Dim> axis;
};

// Calls visit(record, weight) for the nodes of a stencil.
template <int Dim, class Visit>
void each_node(const PatchStore& w, const PointStencil<Dim>& s, Visit visit) {
  for (int q = 0; q < (Dim == 2 ? 3 : 9); ++q) {
    const int i = q % 3, k = q / 3;
    const int column = s.node[0] - 1 + i - w.patch.first[0];
    const int across = Dim == 2 ? 0 : s.node[Dim - 2] - 1 + k - w.patch.first[1];
    const double weight = s.axis[0].weight[i] * (Dim == 2 ? 1.0 : s.axis[Dim - 2].weight[k]);
    if (weight == 0) continue;  // the patch may end here
    const int base = w.base[across * w.patch.count[0] + column] + s.node[Dim - 1] - 1;
    for (int j = 0; j < 3; ++j) visit(static_cast<std::size_t>(base + j), weight * s.axis[Dim - 1].weight[j]);
  }
}

}  // namespace strandlab::mpm
