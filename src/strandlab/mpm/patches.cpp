#include "strandlab/mpm/patches.hpp"

#include <algorithm>
#include <limits>

namespace strandlab::mpm {
namespace {
constexpr int kEmptyLo = std::numeric_limits<int>::max() / 2;
constexpr int kEmptyHi = std::numeric_limits<int>::min() / 2;
}  // namespace

Extents::Extents(std::array<int, 2> f, std::array<int, 2> last)
    : first(f), count{}, flat_(f[1] == last[1] && f[1] == 0) {
  first[0] -= kReach;
  count[0] = last[0] - f[0] + 1 + 2 * kReach;
  count[1] = last[1] - f[1] + 1;
  if (!flat_) {
    first[1] -= kReach;
    count[1] += 2 * kReach;
  }
  lo.assign(static_cast<std::size_t>(count[0]) * count[1], kEmptyLo);
  hi.assign(lo.size(), kEmptyHi);
}

void Extents::add(std::array<int, 2> pencil, int row) {
  const int i = index(pencil);
  lo[i] = std::min(lo[i], row);
  hi[i] = std::max(hi[i], row);
}

void Extents::dilate() {
  const auto spread = [this](int axis) {
    std::vector<int> new_lo(lo.size(), kEmptyLo), new_hi(hi.size(), kEmptyHi);
    for (int j = 0; j < count[1]; ++j) {
      for (int i = 0; i < count[0]; ++i) {
        for (int k = -kReach; k <= kReach; ++k) {
          const int ii = i + (axis == 0 ? k : 0), jj = j + (axis == 1 ? k : 0);
          if (ii < 0 || jj < 0 || ii >= count[0] || jj >= count[1]) continue;
          new_lo[j * count[0] + i] = std::min(new_lo[j * count[0] + i], lo[jj * count[0] + ii]);
          new_hi[j * count[0] + i] = std::max(new_hi[j * count[0] + i], hi[jj * count[0] + ii]);
        }
      }
    }
    lo = std::move(new_lo);
    hi = std::move(new_hi);
  };
  spread(0);
  if (!flat_) spread(1);
  for (std::size_t i = 0; i < lo.size(); ++i) {
    if (lo[i] > hi[i]) continue;
    lo[i] -= kReach;
    hi[i] += kReach;
  }
}

void Extents::merge(std::array<int, 2> a, std::array<int, 2> b) {
  if (!contains(a) || !contains(b)) return;
  const int i = index(a), j = index(b);
  lo[i] = lo[j] = std::min(lo[i], lo[j]);
  hi[i] = hi[j] = std::max(hi[i], hi[j]);
}

void PatchStore::place(const Extents& e, int start) {
  patch.first[0] = e.first[0];
  patch.first[1] = e.first[1];
  patch.count[0] = e.count[0];
  patch.count[1] = e.count[1];
  patch.height = 0;
  lo = e.lo;
  hi = e.hi;
  for (std::size_t i = 0; i < lo.size(); ++i) {
    if (lo[i] > hi[i]) {  // a pencil no point reaches
      lo[i] = 0;
      hi[i] = -1;
    }
    patch.height = std::max(patch.height, hi[i] - lo[i] + 1);
  }
  base.resize(lo.size());
  records = 0;
  for (std::size_t i = 0; i < lo.size(); ++i) {
    base[i] = start + records - lo[i];
    records += hi[i] - lo[i] + 1;
  }
  patch.base = base.data();
}

namespace {

bool find_pencil(const PatchStore& w, const std::array<int, 2>& index, int& pencil) {
  const int i = index[0] - w.patch.first[0], j = index[1] - w.patch.first[1];
  if (i < 0 || j < 0 || i >= w.patch.count[0] || j >= w.patch.count[1]) return false;
  pencil = j * w.patch.count[0] + i;
  return w.hi[pencil] >= w.lo[pencil];
}

PencilField::Rows rows_on(const PatchStore& w, const std::array<int, 2>& index) {
  int p = 0;
  if (!find_pencil(w, index, p)) return {0, 0, 0};
  return {w.base[p], w.lo[p], w.hi[p] + 1};
}

// Pencils of the table along a lateral axis.
struct PencilAxis {
  int first = kEmptyLo, last = kEmptyHi, period = 0;
  int count() const { return last - first + 1; }
  int place_of(int node) const {  // in the table
    if (period == 0) return node - first;
    return (node % period + period) % period;
  }
};

std::array<PencilAxis, 2> pencil_axes(const std::vector<BodyPatches>& bodies, const std::array<int, 2>& periods) {
  std::array<PencilAxis, 2> axes;
  for (int a = 0; a < 2; ++a) {
    for (const auto& body : bodies) {
      axes[a].first = std::min(axes[a].first, body.field.patch.first[a]);
      axes[a].last = std::max(axes[a].last, body.field.patch.first[a] + body.field.patch.count[a] - 1);
    }
    if (periods[a] > 0) axes[a] = {0, periods[a] - 1, periods[a]};
  }
  return axes;
}

struct BodyPencil {
  int body, pencil;
  std::array<int, 2> index;  // of its nodes
};

// Calls visit(pencil, index) for the pencils of a patch that have rows.
template <class Visit>
void each_pencil(const PatchStore& w, Visit visit) {
  for (int p = 0; p < w.pencils(); ++p) {
    if (w.hi[p] < w.lo[p]) continue;
    visit(p, std::array<int, 2>{w.patch.first[0] + p % w.patch.count[0], w.patch.first[1] + p / w.patch.count[0]});
  }
}

// Pencils of all bodies sorted by place in the table, at each by body: those of place i begin at start[i].
struct SortedPencils {
  std::vector<int> start;
  std::vector<BodyPencil> pencils;
};

SortedPencils sort_pencils(const std::vector<BodyPatches>& bodies, const std::array<PencilAxis, 2>& axes) {
  const auto place = [&](const std::array<int, 2>& index) {
    return static_cast<std::size_t>(axes[1].place_of(index[1])) * axes[0].count() + axes[0].place_of(index[0]);
  };
  SortedPencils sorted;
  sorted.start.assign(static_cast<std::size_t>(axes[0].count()) * axes[1].count() + 1, 0);
  for (const auto& body : bodies)
    each_pencil(body.field, [&](int, const std::array<int, 2>& index) { ++sorted.start[place(index) + 1]; });
  for (std::size_t i = 1; i < sorted.start.size(); ++i) sorted.start[i] += sorted.start[i - 1];
  sorted.pencils.resize(static_cast<std::size_t>(sorted.start.back()));
  auto next = sorted.start;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    each_pencil(bodies[b].field, [&](int p, const std::array<int, 2>& index) {
      sorted.pencils[static_cast<std::size_t>(next[place(index)]++)] = {static_cast<int>(b), p, index};
    });
  }
  return sorted;
}

PencilField field_of(const BodyPencil& at, const BodyPatches& body) {
  PencilField field{};
  field.body = at.body;
  for (int a = 0; a < 2; ++a) field.index[a] = at.index[a];
  field.base = body.field.base[at.pencil];
  field.row_lo = body.field.lo[at.pencil];
  field.row_hi = body.field.hi[at.pencil] + 1;
  field.faces = static_cast<int>(body.faces.size());
  for (int f = 0; f < field.faces; ++f) field.face[f] = rows_on(body.faces[f], at.index);
  for (int k = 0; k < 2; ++k) field.mirror[k] = rows_on(body.mirrors[k], at.index);
  return field;
}

// For every row of a pencil the fields whose patches hold it.
void add_rows(Pencil& pencil, PencilTable& table) {
  pencil.row_lo = kEmptyLo;
  pencil.row_hi = kEmptyHi;
  for (int f = pencil.field_begin; f < pencil.field_end; ++f) {
    pencil.row_lo = std::min(pencil.row_lo, table.fields[f].row_lo);
    pencil.row_hi = std::max(pencil.row_hi, table.fields[f].row_hi);
  }
  pencil.slots = static_cast<int>(table.row_start.size());
  for (int row = pencil.row_lo; row < pencil.row_hi; ++row) {
    table.row_start.push_back(static_cast<int>(table.slots.size()));
    for (int f = pencil.field_begin; f < pencil.field_end; ++f) {
      const PencilField& field = table.fields[f];
      if (row < field.row_lo || row >= field.row_hi) continue;
      unsigned faces = 0;
      for (int k = 0; k < field.faces; ++k)
        faces |= static_cast<unsigned>(row >= field.face[k].row_lo && row < field.face[k].row_hi) << k;
      table.slots.push_back({static_cast<unsigned short>(f - pencil.field_begin), static_cast<unsigned short>(faces)});
    }
  }
  table.row_start.push_back(static_cast<int>(table.slots.size()));
}

}  // namespace

PencilTable tabulate(const std::vector<BodyPatches>& bodies, const std::array<std::array<int, 2>, 2>& walls,
                     const std::array<int, 2>& periods) {
  PencilTable table;
  if (bodies.empty()) return table;
  const auto axes = pencil_axes(bodies, periods);
  const auto sorted = sort_pencils(bodies, axes);
  for (std::size_t place = 0; place + 1 < sorted.start.size(); ++place) {
    if (sorted.start[place] == sorted.start[place + 1]) continue;
    Pencil pencil{};
    const auto along = static_cast<int>(place) % axes[0].count(), across = static_cast<int>(place) / axes[0].count();
    pencil.index[0] = axes[0].first + along;
    pencil.index[1] = axes[1].first + across;
    for (int a = 0; a < 2; ++a) {
      const bool below = walls[a][0] != kNoWall && pencil.index[a] < walls[a][0];
      const bool above = walls[a][1] != kNoWall && pencil.index[a] > walls[a][1];
      if (below || above) pencil.ghost = 1;
    }
    pencil.field_begin = static_cast<int>(table.fields.size());
    for (int i = sorted.start[place]; i < sorted.start[place + 1]; ++i) {
      const auto& at = sorted.pencils[static_cast<std::size_t>(i)];
      table.fields.push_back(field_of(at, bodies[static_cast<std::size_t>(at.body)]));
    }
    pencil.field_end = static_cast<int>(table.fields.size());
    add_rows(pencil, table);
    table.pencils.push_back(pencil);
  }
  return table;
}

}  // namespace strandlab::mpm
