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
  for (std::size_t i = 0; i < lo.size(); ++i) base[i] = start + static_cast<int>(i) * patch.height - lo[i];
  records = static_cast<int>(lo.size()) * patch.height;
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

// The fields of one pencil, by body.
void add_fields(const std::vector<BodyPatches>& bodies, const std::array<int, 2>& index, PencilTable& table) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    int p = 0;
    if (!find_pencil(bodies[b].field, index, p)) continue;
    PencilField field{};
    field.body = static_cast<int>(b);
    field.base = bodies[b].field.base[p];
    field.row_lo = bodies[b].field.lo[p];
    field.row_hi = bodies[b].field.hi[p] + 1;
    field.faces = static_cast<int>(bodies[b].faces.size());
    for (int f = 0; f < field.faces; ++f) field.face[f] = rows_on(bodies[b].faces[f], index);
    for (int k = 0; k < 2; ++k) field.mirror[k] = rows_on(bodies[b].mirrors[k], index);
    table.fields.push_back(field);
  }
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

PencilTable tabulate(const std::vector<BodyPatches>& bodies, const std::array<std::array<int, 2>, 2>& walls) {
  std::array<int, 2> first{kEmptyLo, kEmptyLo}, last{kEmptyHi, kEmptyHi};
  for (const auto& body : bodies) {
    for (int a = 0; a < 2; ++a) {
      first[a] = std::min(first[a], body.field.patch.first[a]);
      last[a] = std::max(last[a], body.field.patch.first[a] + body.field.patch.count[a] - 1);
    }
  }
  PencilTable table;
  for (int j = first[1]; j <= last[1]; ++j) {
    for (int i = first[0]; i <= last[0]; ++i) {
      const std::array<int, 2> index{i, j};
      Pencil pencil{};
      pencil.index[0] = i;
      pencil.index[1] = j;
      for (int a = 0; a < 2; ++a) {
        const bool below = walls[a][0] != kNoWall && index[a] < walls[a][0];
        const bool above = walls[a][1] != kNoWall && index[a] > walls[a][1];
        if (below || above) pencil.ghost = 1;
      }
      pencil.field_begin = static_cast<int>(table.fields.size());
      add_fields(bodies, index, table);
      pencil.field_end = static_cast<int>(table.fields.size());
      if (pencil.field_end == pencil.field_begin) continue;
      add_rows(pencil, table);
      table.pencils.push_back(pencil);
    }
  }
  return table;
}

}  // namespace strandlab::mpm
