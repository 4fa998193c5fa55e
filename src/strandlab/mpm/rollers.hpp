// Rollers: a body continues behind them as its mirror image.
#pragma once

#include "strandlab/mpm/fields.hpp"

namespace strandlab::mpm {

// Calls visit(axis, side, ghost record, mirror record, records to fold) for a patch's nodes one cell behind each
// roller. In 3D a corner's ghosts go over one axis, then over the other; `reverse`: the other way round.
template <int Dim, class Visit>
void each_ghost(const PatchStore& w, const Step<Dim>& step, bool reverse, Visit visit) {
  for (int n = 0; n < Dim - 1; ++n) {
    const int a = reverse ? Dim - 2 - n : n;
    for (int side = 0; side < 2; ++side) {
      if (step.wall[a][side] == kNoWall) continue;
      const int outward = side == 0 ? -1 : 1;
      const int ghost = step.wall[a][side] + outward - w.patch.first[a],
                mirror = step.wall[a][side] - outward - w.patch.first[a];
      if (ghost < 0 || mirror < 0 || ghost >= w.patch.count[a] || mirror >= w.patch.count[a]) continue;
      const int other = 1 - a;
      for (int k = 0; k < w.patch.count[other]; ++k) {
        const auto pencil = [&](int i) { return a == 0 ? k * w.patch.count[0] + i : i * w.patch.count[0] + k; };
        const int g = pencil(ghost), m = pencil(mirror);
        if (w.hi[g] < w.lo[g]) continue;
        visit(a, side, w.base[g] + w.lo[g], w.base[m] + w.lo[g], w.hi[g] - w.lo[g] + 1);
      }
    }
  }
}

// Calls visit(axis, side, first record, count) for a patch's nodes on each roller plane.
template <int Dim, class Visit>
void each_wall(const PatchStore& w, const Step<Dim>& step, Visit visit) {
  for (int a = 0; a < Dim - 1; ++a) {
    for (int side = 0; side < 2; ++side) {
      const int at = step.wall[a][side] - w.patch.first[a];
      if (step.wall[a][side] == kNoWall || at < 0 || at >= w.patch.count[a]) continue;
      for (int k = 0; k < w.patch.count[1 - a]; ++k) {
        const int p = a == 0 ? k * w.patch.count[0] + at : at * w.patch.count[0] + k;
        if (w.hi[p] >= w.lo[p]) visit(a, side, w.base[p] + w.lo[p], w.hi[p] - w.lo[p] + 1);
      }
    }
  }
}

// After scatter: what fell on the ghost nodes is added to their mirror images.
template <int Dim>
void fold(const Step<Dim>& step, Fields& fields);

// After the grid update: the ghost nodes of the bodies are the mirror images again.
template <int Dim>
void unfold(const Step<Dim>& step, Fields& fields);

}  // namespace strandlab::mpm
