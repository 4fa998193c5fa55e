// Particles to grid: mass, momentum and internal force; face points to the face records.
#pragma once

#include "strandlab/mpm/kernels.hpp"
#include "strandlab/mpm/kernels/pack.hpp"
#include "strandlab/mpm/kernels/stencil.hpp"
#include "strandlab/mpm/kernels/stopwatch.hpp"
#include "strandlab/mpm/kernels/strand_axes.hpp"

namespace strandlab::mpm::STRANDLAB_ISA {
namespace {

// Per-lane node contributions as packs over the record: node += w*(momentum row) + grad w . (stress columns), with
// m_i = sum w m, p_i = sum w m v, f_i = - sum V0 tau grad w.
template <int Dim>
struct Rows;
template <>
struct Rows<2> {
  Pack row[kBlock];  // {m, px, py, -Vxx, -Vxy, -Vyy, 0, 0}
};
template <>
struct Rows<3> {
  Pack row[kBlock];     // {m, px, py, pz, 0...}
  Pack stress[kBlock];  // {-Vxx, -Vyy, -Vzz, -Vyz, -Vxz, -Vxy, 0, 0}
};

STRANDLAB_INLINE void prepare(const Pack (&v)[2], const Pack (&F)[4], const Pack* tau, double mass, double volume,
                              Rows<2>& r) {
  Pack s[3];
  panel_stress(F, tau, volume, s);
  r.row[0] = splat(mass);
  r.row[1] = v[0] * mass;
  r.row[2] = v[1] * mass;
  for (int k = 0; k < 3; ++k) r.row[3 + k] = -s[k];
  r.row[6] = r.row[7] = Pack{};
  transpose(r.row);
}
STRANDLAB_INLINE void prepare(const Pack (&v)[3], const Pack (&F)[9], const Pack* tau, double mass, double volume,
                              Rows<3>& r) {
  Pack s[6];
  panel_stress(F, tau, volume, s);
  r.row[0] = splat(mass);
  for (int a = 0; a < 3; ++a) r.row[1 + a] = v[a] * mass;
  for (int k = 4; k < 8; ++k) r.row[k] = Pack{};
  transpose(r.row);
  for (int k = 0; k < 6; ++k) r.stress[k] = -s[k];
  r.stress[6] = r.stress[7] = Pack{};
  transpose(r.stress);
}

STRANDLAB_INLINE void add(double* record, const Pack& a) {
  store(record, load(record) + a);
}

STRANDLAB_INLINE void scatter_lane(const Rows<2>& r, const Stencil<2>& s, const Patch& patch, int l, double* nodes) {
  const Pack zero{};
  const Pack momentum = __builtin_shufflevector(r.row[l], zero, 0, 1, 2, 8, 8, 8, 8, 8);
  const Pack column_x = __builtin_shufflevector(r.row[l], zero, 8, 8, 8, 3, 4, 8, 8, 8);
  const Pack column_y = __builtin_shufflevector(r.row[l], zero, 8, 8, 8, 4, 5, 8, 8, 8);
  int record[3];
  pencil_records<2>(patch, s, l, record);
  for (int q = 0; q < 3; ++q) {
    const double wx = s.w[0][q][l];
    const Pack by_weight = momentum * wx + column_x * s.g[0][q][l];
    const Pack by_gradient = column_y * wx;
    double* node = nodes + kRecord * static_cast<long>(record[q]);
    for (int j = 0; j < 3; ++j) add(node + kRecord * j, by_weight * s.w[1][j][l] + by_gradient * s.g[1][j][l]);
  }
}
STRANDLAB_INLINE void scatter_lane(const Rows<3>& r, const Stencil<3>& s, const Patch& patch, int l, double* nodes) {
  const Pack zero{};
  const Pack& momentum = r.row[l];
  const Pack column_x = __builtin_shufflevector(r.stress[l], zero, 8, 8, 8, 8, 0, 5, 4, 8);
  const Pack column_y = __builtin_shufflevector(r.stress[l], zero, 8, 8, 8, 8, 5, 1, 3, 8);
  const Pack column_z = __builtin_shufflevector(r.stress[l], zero, 8, 8, 8, 8, 4, 3, 2, 8);
  int record[9];
  pencil_records<3>(patch, s, l, record);
  for (int q = 0; q < 9; ++q) {
    const double w = pencil_weight<3>(s, q, l);
    const Pack by_weight =
        momentum * w + column_x * pencil_gradient<3>(s, 0, q, l) + column_y * pencil_gradient<3>(s, 1, q, l);
    const Pack by_gradient = column_z * w;
    double* node = nodes + kRecord * static_cast<long>(record[q]);
    for (int j = 0; j < 3; ++j) add(node + kRecord * j, by_weight * s.w[2][j][l] + by_gradient * s.g[2][j][l]);
  }
}

// The mirror image of eight particles in platen k: reflected position, velocity relative to the platen, and stress.
template <int Dim>
STRANDLAB_INLINE void scatter_mirror(const Pack (&x)[Dim], const Pack (&v)[Dim], const Pack (&F)[Dim * Dim],
                                     const Pack (&tau)[6], const BodyView<Dim>& body, const Step<Dim>& step, int k,
                                     int lanes, double* nodes) {
  constexpr int y = Dim - 1;
  const Pack depth = absolute(x[y] - step.platen[k].position) * step.inverse_cell[y];
  const Mask close = depth < kMirrorDepth;
  if (!any(close)) return;
  Pack mx[Dim], mv[Dim], mF[Dim * Dim], mtau[6];
  for (int a = 0; a < Dim; ++a) {
    mx[a] = a == y ? 2 * step.platen[k].position - x[a] : x[a];
    mv[a] = a == y ? 2 * step.platen[k].velocity - v[a] : v[a];
    for (int b = 0; b < Dim; ++b) mF[a * Dim + b] = (a == y) == (b == y) ? F[a * Dim + b] : -F[a * Dim + b];
  }
  for (int c = 0; c < (Dim == 2 ? 4 : 6); ++c) mtau[c] = c == 3 || c == 4 ? -tau[c] : tau[c];  // 13 and 23 change sign
  Stencil<Dim> s;
  stencil_at<Dim>(mx, mF, body.half_size, step, s);
  Rows<Dim> rows;
  prepare(mv, mF, mtau, body.mass, body.volume, rows);
  for (int l = 0; l < lanes; ++l) {
    if (close[l]) scatter_lane(rows, s, body.mirror[k], l, nodes);
  }
}

// cof(F) A: the area vector of a material surface element now.
STRANDLAB_INLINE void current_area(const Pack (&F)[4], const Pack (&A)[2], Pack (&N)[2]) {
  N[0] = F[3] * A[0] - F[2] * A[1];
  N[1] = F[0] * A[1] - F[1] * A[0];
}
STRANDLAB_INLINE void current_area(const Pack (&F)[9], const Pack (&A)[3], Pack (&N)[3]) {
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    N[a] = Pack{};
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      N[a] += (F[3 * b + j] * F[3 * c + k] - F[3 * b + k] * F[3 * c + j]) * A[i];
    }
  }
}

// One pack of face points onto the surface records of their face.
template <int Dim>
STRANDLAB_INLINE void scatter_surface(const SurfaceView<Dim>& face, int pack, const BodyView<Dim>& body,
                                      const Step<Dim>& step, double* surface) {
  constexpr int kSize = kSurfaceRecord<Dim>;
  Pack x[Dim], F[Dim * Dim], offset[Dim], area[Dim];
  const int* where = face.where + pack * kBlock;
  const bool contiguous = where[kBlock - 1] - where[0] == kBlock - 1;  // a strand's top or bottom: one block
  const auto collect = [&](int component) {
    if (contiguous) return load(body.blocks + where[0] + component * kBlock);
    alignas(64) double lane[kBlock];
    for (int l = 0; l < kBlock; ++l) lane[l] = body.blocks[where[l] + component * kBlock];
    return load(lane);
  };
  for (int a = 0; a < Dim; ++a) x[a] = collect(a);
  for (int a = 0; a < Dim * Dim; ++a) F[a] = collect(Component<Dim>::F + a);
  load_packs(face.offset + static_cast<long>(pack) * Dim * kBlock, offset);
  load_packs(face.area + static_cast<long>(pack) * Dim * kBlock, area);
  Pack N[Dim];
  current_area(F, area, N);
  Pack size2{}, along{};
  for (int a = 0; a < Dim; ++a) {
    for (int b = 0; b < Dim; ++b) x[a] += F[a * Dim + b] * offset[b];
  }
  for (int a = 0; a < Dim; ++a) {
    size2 += N[a] * N[a];
    along += N[a] * x[a];
  }
  Stencil<Dim> s;
  stencil_at<Dim>(x, F, body.half_size, step, s);
  Pack row[8] = {};
  for (int a = 0; a < Dim; ++a) row[a] = N[a];
  row[Dim] = square_root(size2);
  row[Dim + 1] = along;
  transpose(row);
  for (int l = 0; l < kBlock; ++l) {
    if (row[l][Dim] == 0) continue;  // padding
    int record[kPencils<Dim>];
    pencil_records<Dim>(face.patch, s, l, record);
    for (int q = 0; q < kPencils<Dim>; ++q) {
      double* node = surface + kSize * static_cast<long>(record[q]);
      const double w = pencil_weight<Dim>(s, q, l);
      for (int j = 0; j < 3; ++j) {
        const double wj = w * s.w[Dim - 1][j][l];
        if constexpr (Dim == 2) {
          const Quad part = __builtin_shufflevector(row[l], row[l], 0, 1, 2, 3);
          Quad n;
          __builtin_memcpy(&n, node + kSize * j, sizeof n);
          n += part * wj;
          __builtin_memcpy(node + kSize * j, &n, sizeof n);
        } else {
          add(node + kSize * j, row[l] * wj);
        }
      }
    }
  }
}

template <int Dim>
void scatter(const Tile& tile, const BodyView<Dim>& body, const Step<Dim>& step, double* nodes, double* surface,
             const unsigned char* lanes, bool timed, TileResult& result) {
  using C = Component<Dim>;
  Stopwatch watch(timed);
  const long stride = static_cast<long>(C::count(body.components)) * kBlock;
  for (int b = tile.block_begin; b < tile.block_end; ++b) {
    const double* block = body.blocks + b * stride;
    prefetch(block, stride);
    Pack x[Dim], v[Dim], F[Dim * Dim], tau[6];
    load_packs(block, x);
    load_packs(block + C::v * kBlock, v);
    load_packs(block + C::F * kBlock, F);
    for (int k = 0; k < (Dim == 2 ? 4 : 6); ++k) tau[k] = load(block + (C::stress + k) * kBlock);
    Stencil<Dim> s;
    stencil_at<Dim>(x, F, body.half_size, step, s);
    watch(result.ticks.weights);
    Rows<Dim> rows;
    prepare(v, F, tau, body.mass, body.volume, rows);
    for (int l = 0; l < lanes[b]; ++l) scatter_lane(rows, s, body.patch, l, nodes);
    for (int k = 0; k < 2; ++k) {
      if (body.mirror[k].height > 0) scatter_mirror<Dim>(x, v, F, tau, body, step, k, lanes[b], nodes);
    }
    watch(result.ticks.scatter);
  }
  for (int f = 0; f < body.faces; ++f) {
    for (int p = tile.face_begin[f]; p < tile.face_end[f]; ++p)
      scatter_surface<Dim>(body.face[f], p, body, step, surface);
  }
  watch(result.ticks.surface);
}

}  // namespace
}  // namespace strandlab::mpm::STRANDLAB_ISA
