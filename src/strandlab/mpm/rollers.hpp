// Rollers: a body continues behind them as its mirror image.
#pragma once

#include "strandlab/mpm/fields.hpp"

namespace strandlab::mpm {

// Calls visit(axis, side, ghost record, mirror record, records to fold) for a window's nodes one cell behind each
// roller. In 3D a corner's ghosts go over one axis, then over the other; `reverse`: the other way round.
template <int Dim, class Visit>
void each_ghost(const WindowStore& w, const Frame<Dim>& f, bool reverse, Visit visit) {
  for (int n = 0; n < Dim - 1; ++n) {
    const int a = reverse ? Dim - 2 - n : n;
    for (int side = 0; side < 2; ++side) {
      if (f.wall[a][side] == kNoWall) continue;
      const int step = side == 0 ? -1 : 1;
      const int ghost = f.wall[a][side] + step - w.window.first[a], mirror = f.wall[a][side] - step - w.window.first[a];
      if (ghost < 0 || mirror < 0 || ghost >= w.window.count[a] || mirror >= w.window.count[a]) continue;
      const int other = 1 - a;
      for (int k = 0; k < w.window.count[other]; ++k) {
        const auto pencil = [&](int i) { return a == 0 ? k * w.window.count[0] + i : i * w.window.count[0] + k; };
        const int g = pencil(ghost), m = pencil(mirror);
        if (w.hi[g] < w.lo[g]) continue;
        visit(a, side, w.base[g] + w.lo[g], w.base[m] + w.lo[g], w.hi[g] - w.lo[g] + 1);
      }
    }
  }
}

// Calls visit(axis, side, first record, count) for a window's nodes on each roller plane.
template <int Dim, class Visit>
void each_wall(const WindowStore& w, const Frame<Dim>& f, Visit visit) {
  for (int a = 0; a < Dim - 1; ++a) {
    for (int side = 0; side < 2; ++side) {
      const int at = f.wall[a][side] - w.window.first[a];
      if (f.wall[a][side] == kNoWall || at < 0 || at >= w.window.count[a]) continue;
      for (int k = 0; k < w.window.count[1 - a]; ++k) {
        const int p = a == 0 ? k * w.window.count[0] + at : at * w.window.count[0] + k;
        if (w.hi[p] >= w.lo[p]) visit(a, side, w.base[p] + w.lo[p], w.hi[p] - w.lo[p] + 1);
      }
    }
  }
}

// After scatter: what fell on the ghost nodes is added to their mirror images.
template <int Dim>
void fold(const Frame<Dim>& f, Fields& fields);

// After the grid update: the ghost nodes of the bodies are the mirror images again.
template <int Dim>
void unfold(const Frame<Dim>& f, Fields& fields);

}  // namespace strandlab::mpm
