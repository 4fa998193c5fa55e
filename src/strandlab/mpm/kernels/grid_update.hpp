// Momentum balance at the nodes of a pencil, then contact row by row.
#pragma once

#include "strandlab/mpm/kernels.hpp"
#include "strandlab/mpm/kernels/contact.hpp"
#include "strandlab/mpm/kernels/encounters.hpp"
#include "strandlab/mpm/kernels/pack.hpp"
#include "strandlab/mpm/kernels/stopwatch.hpp"

namespace strandlab::mpm::STRANDLAB_ISA {
namespace {

// A node record before the update, {m, p, f, ...}, as {p, f, ...} and as {f, ...}.
template <int Dim>
STRANDLAB_INLINE Pack momentum_and_force(const Pack& r) {
  const Pack zero{};
  if constexpr (Dim == 2)
    return __builtin_shufflevector(r, zero, 1, 2, 3, 4, 8, 8, 8, 8);
  else
    return __builtin_shufflevector(r, zero, 1, 2, 3, 4, 5, 6, 8, 8);
}
template <int Dim>
STRANDLAB_INLINE Pack second_vector(const Pack& r) {
  const Pack zero{};
  if constexpr (Dim == 2)
    return __builtin_shufflevector(r, zero, 2, 3, 8, 8, 8, 8, 8, 8);
  else
    return __builtin_shufflevector(r, zero, 3, 4, 5, 8, 8, 8, 8, 8);
}

// What a record is multiplied with: {v, dv} = scale {p, f}/m. On a roller plane the normal component is zero.
template <int Dim>
STRANDLAB_INLINE Pack node_scale(const Pencil& pencil, const Step<Dim>& step) {
  Pack scale{};
  for (int d = 0; d < Dim; ++d) {
    const bool on_wall = d < Dim - 1 && (pencil.index[d] == step.wall[d][0] || pencil.index[d] == step.wall[d][1]);
    if (on_wall) continue;
    scale[d] = 1;
    scale[Dim + d] = step.dt;
  }
  return scale;
}

// v = p/m + dv, dv = dt f/m: the record becomes {v, dv, ..., m}. Returns sum m {v^2, dv^2} of the nodes.
template <int Dim>
STRANDLAB_INLINE Pack advance_nodes(const PencilField::Rows& rows, const Pack& scale, double* nodes) {
  Pack squares{};
  double* r = nodes + kRecord * static_cast<long>(rows.base + rows.row_lo);
  for (int row = rows.row_lo; row < rows.row_hi; ++row, r += kRecord) {
    const Pack record = load(r);
    const double mass = record[0];
    const double inverse = mass > 0 ? 1 / mass : 0;
    const Pack before = momentum_and_force<Dim>(record) * inverse * scale;
    Pack after = before + second_vector<Dim>(before);
    squares += mass * after * after;
    after[7] = mass;
    store(r, after);
  }
  return squares;
}

// Momentum balance at the nodes of a field and of its mirror images on a pencil, and its energies before contact: 1/2
// sum m |dv|^2, of which lumping the mass costs a part when the particles take up dv.
template <int Dim>
STRANDLAB_INLINE void momentum_balance(const PencilField& field, const Pack& scale, const GridView<Dim>& grid,
                                       PencilResult& result) {
  const Pack squares = advance_nodes<Dim>({field.base, field.row_lo, field.row_hi}, scale, grid.nodes);
  for (int k = 0; k < 2; ++k) advance_nodes<Dim>(field.mirror[k], scale, grid.nodes);
  for (int d = 0; d < Dim; ++d) {
    result.kinetic_change += 0.5 * squares[Dim + d];
    result.force_change += 0.5 * squares[Dim + d];
  }
}

// Contact at the nodes of one row of a pencil, momentum conserving, independent of the order of the bodies. Two bodies
// that meet far from the platens are put into `encounters`, for later.
//
// A pair is looked at from a quarter of a cell between its faces on. Closer faces act only if they would cross within
// the step, so that the number decides what is looked at; it must hold what a step can close (at 64 m/s a few
// hundredths of a cell). Judgement; a twentieth of a cell loses contacts (faces_test.cpp).
template <int Dim>
STRANDLAB_INLINE void contact_row(const Pencil& pencil, int row, const Step<Dim>& step, const GridView<Dim>& grid,
                                  Encounters<Dim>& encounters, PencilResult& result) {
  const double cell = step.cell[Dim - 1], reach = 0.25 * cell;
  const int begin = grid.row_start[pencil.slots + row - pencil.row_lo];
  const int end = grid.row_start[pencil.slots + row - pencil.row_lo + 1];
  const double height = step.origin[Dim - 1] + row * cell;
  bool platen[2];
  for (int k = 0; k < 2; ++k) {
    platen[k] = step.platen[k].present && (step.platen[k].position - height) * (k == 0 ? -1 : 1) < 1.5 * cell;
  }
  const int least = platen[0] || platen[1] ? 1 : 2;
  if (end - begin < least) return;
  Meeting<Dim> m[3 * kMaxFields];
  const RowField* origin[kMaxFields];
  int fields = 0;
  for (int s = begin; s < end; ++s) {
    const PencilField& field = grid.fields[pencil.field_begin + grid.slots[s].field];
    double* record = grid.nodes + kRecord * static_cast<long>(field.base + row);
    if (!(record[7] > 0)) continue;
    if (fields == kMaxFields) {
      ++result.overflow;
      break;
    }
    m[fields].record = record;
    origin[fields++] = &grid.slots[s];
  }
  result.most_fields = fields > result.most_fields ? fields : result.most_fields;
  if (fields < least) return;
  const int real = fields;
  const auto field_of = [&](int i) -> const PencilField& { return grid.fields[pencil.field_begin + origin[i]->field]; };
  for (int i = 0; i < real; ++i) find_faces<Dim>(field_of(i), origin[i]->faces, row, height, step, grid.surface, m[i]);
  Pair<Dim> pairs[kMaxFields * (kMaxFields + 3) / 2];
  if (real == 2 && least == 2) {
    if (find_pair<Dim>(m[0], m[1], reach, pairs[0])) add<Dim>(m[0].record, m[1].record, pairs[0], encounters);
    return;
  }
  int count = 0;
  for (int i = 0; i < real; ++i) {
    for (int j = i + 1; j < real; ++j) {
      Pair<Dim>& pair = pairs[count];
      if (!find_pair<Dim>(m[i], m[j], reach, pair)) continue;
      pair.a = i;
      pair.b = j;
      pair.friction = grid.friction;
      ++count;
    }
    for (int k = 0; k < 2; ++k) {
      Pair<Dim>& pair = pairs[count];
      if (!platen[k] || !platen_pair<Dim>(m[i], step, k, height, reach, pair)) continue;
      if (!has_mirror<Dim>(field_of(i), k, row, grid, m[fields])) continue;
      pair.a = i;
      pair.b = fields++;
      pair.friction = grid.platen_friction[k];
      ++count;
    }
  }
  if (count > 0) resolve<Dim>(m, fields, real, pairs, count, step, result);
}

template <int Dim>
void update_grid(const Pencil& pencil, const Step<Dim>& step, const GridView<Dim>& grid, bool timed,
                 PencilResult& result) {
  if (pencil.ghost) return;
  const Pack scale = node_scale<Dim>(pencil, step);
  for (int f = pencil.field_begin; f < pencil.field_end; ++f)
    momentum_balance<Dim>(grid.fields[f], scale, grid, result);
  Stopwatch watch(timed);
  Encounters<Dim> encounters;
  for (int row = pencil.row_lo; row < pencil.row_hi; ++row) {
    contact_row<Dim>(pencil, row, step, grid, encounters, result);
    if (encounters.count == kBlock) resolve<Dim>(encounters, step, grid.friction, result);
  }
  resolve<Dim>(encounters, step, grid.friction, result);
  watch(result.contact_ticks);
}

}  // namespace
}  // namespace strandlab::mpm::STRANDLAB_ISA
