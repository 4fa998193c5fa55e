// Grid to particles: velocity, position, deformation, stress.
#pragma once

#include "strandlab/mpm/kernels.hpp"
#include "strandlab/mpm/kernels/pack.hpp"
#include "strandlab/mpm/kernels/stencil.hpp"
#include "strandlab/mpm/kernels/stopwatch.hpp"
#include "strandlab/mpm/kernels/strand_axes.hpp"
#include "strandlab/mpm/kernels/stress.hpp"

namespace strandlab::mpm::STRANDLAB_ISA {
namespace {

// Velocity, its change and its gradient at eight particles.
template <int Dim>
struct Motion {
  Pack v[Dim], dv[Dim];
  Pack L[Dim * Dim];  // dv_i/dx_j, row-major
};

STRANDLAB_INLINE void gather_motion(const Stencil<2>& s, const Patch& patch, const double* nodes, int lanes,
                                    Motion<2>& m) {
  Pack row[8] = {};
  for (int l = 0; l < lanes; ++l) {
    int record[3];
    pencil_records<2>(patch, s, l, record);
    Quad value{}, dx{}, dy{};
    for (int q = 0; q < 3; ++q) {
      const double* node = nodes + kRecord * static_cast<long>(record[q]);
      Quad t{}, u{};
      for (int j = 0; j < 3; ++j) {
        Quad n;
        __builtin_memcpy(&n, node + kRecord * j, sizeof n);
        t += n * s.w[1][j][l];
        u += n * s.g[1][j][l];
      }
      value += t * s.w[0][q][l];
      dx += t * s.g[0][q][l];
      dy += u * s.w[0][q][l];
    }
    const Quad gradient = __builtin_shufflevector(dx, dy, 0, 4, 1, 5);  // {vx,x vx,y vy,x vy,y}
    row[l] = __builtin_shufflevector(value, gradient, 0, 1, 2, 3, 4, 5, 6, 7);
  }
  for (int l = lanes; l < kBlock; ++l) row[l] = row[lanes > 1 ? lanes - 1 : 0];  // padding follows the last particle
  transpose(row);
  for (int a = 0; a < 2; ++a) {
    m.v[a] = row[a];
    m.dv[a] = row[2 + a];
  }
  for (int k = 0; k < 4; ++k) m.L[k] = row[4 + k];
}

STRANDLAB_INLINE void gather_motion(const Stencil<3>& s, const Patch& patch, const double* nodes, int lanes,
                                    Motion<3>& m) {
  Pack value[8] = {}, gx[8] = {}, gy[8] = {}, gz[8] = {};
  for (int l = 0; l < lanes; ++l) {
    int record[9];
    pencil_records<3>(patch, s, l, record);
    for (int q = 0; q < 9; ++q) {
      const double* node = nodes + kRecord * static_cast<long>(record[q]);
      Pack t{}, u{};
      for (int j = 0; j < 3; ++j) {
        const Pack n = load(node + kRecord * j);
        t += n * s.w[2][j][l];
        u += n * s.g[2][j][l];
      }
      const double w = pencil_weight<3>(s, q, l);
      value[l] += t * w;
      gx[l] += t * pencil_gradient<3>(s, 0, q, l);
      gy[l] += t * pencil_gradient<3>(s, 1, q, l);
      gz[l] += u * w;
    }
  }
  const int last = lanes > 1 ? lanes - 1 : 0;
  Pack first[8], second[8];
  for (int l = 0; l < kBlock; ++l) {
    const int k = l < lanes ? l : last;
    first[l] = __builtin_shufflevector(value[k], gx[k], 0, 1, 2, 3, 4, 5, 8, 9);
    const Pack yz = __builtin_shufflevector(gy[k], gz[k], 0, 1, 2, 8, 9, 10, 0, 0);
    second[l] = __builtin_shufflevector(yz, gx[k], 0, 1, 2, 3, 4, 5, 10, 10);
  }
  transpose(first);   // v, dv, vx,x vy,x
  transpose(second);  // vx,y vy,y vz,y vx,z vy,z vz,z vz,x
  for (int a = 0; a < 3; ++a) {
    m.v[a] = first[a];
    m.dv[a] = first[3 + a];
    m.L[3 * a + 1] = second[a];
    m.L[3 * a + 2] = second[3 + a];
  }
  m.L[0] = first[6];
  m.L[3] = first[7];
  m.L[6] = second[6];
}

// F <- exp(dt L) F to second order (a pure rotation adds no volume to fourth order); returns the middle F.
template <int Dim>
STRANDLAB_INLINE void advance_F(const Pack (&A)[Dim * Dim], Pack (&F)[Dim * Dim], Pack (&middle)[Dim * Dim]) {
  Pack G[Dim * Dim];
  for (int i = 0; i < Dim; ++i) {
    for (int j = 0; j < Dim; ++j) {
      Pack t = A[i * Dim] * F[j];
      for (int k = 1; k < Dim; ++k) t += A[i * Dim + k] * F[k * Dim + j];
      G[i * Dim + j] = t;
    }
  }
  for (int i = 0; i < Dim; ++i) {
    for (int j = 0; j < Dim; ++j) {
      Pack t = G[i * Dim + j];
      for (int k = 0; k < Dim; ++k) t += 0.5 * A[i * Dim + k] * G[k * Dim + j];
      middle[i * Dim + j] = F[i * Dim + j] + 0.5 * t;
      F[i * Dim + j] += t;
    }
  }
}

STRANDLAB_INLINE Pack determinant(const Pack (&F)[4]) {
  return F[0] * F[3] - F[1] * F[2];
}
STRANDLAB_INLINE Pack determinant(const Pack (&F)[9]) {
  return F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) + F[2] * (F[3] * F[7] - F[4] * F[6]);
}

template <int Dim>
void gather(const Tile& tile, const BodyView<Dim>& body, const Step<Dim>& step, const double* nodes,
            const unsigned char* lanes, bool timed, TileResult& result) {
  using C = Component<Dim>;
  Stopwatch watch(timed);
  const long stride = static_cast<long>(C::count(body.components)) * kBlock;
  Pack plastic{}, kinetic{}, stress_change{}, drift[Dim] = {};
  for (int b = tile.block_begin; b < tile.block_end; ++b) {
    double* block = body.blocks + b * stride;
    prefetch(block, stride);
    Pack x[Dim], F[Dim * Dim];
    load_packs(block, x);
    load_packs(block + C::F * kBlock, F);
    Stencil<Dim> s;
    stencil_at<Dim>(x, F, body.half_size, step, s);
    watch(result.ticks.weights);
    Motion<Dim> motion;
    gather_motion(s, body.patch, nodes, lanes[b], motion);
    Mask real;
    for (int l = 0; l < kBlock; ++l) real[l] = l < lanes[b] ? -1 : 0;
    Pack change{}, moved[Dim];
    for (int a = 0; a < Dim; ++a) {
      const Pack dx = step.dt * motion.v[a];
      store(block + a * kBlock, x[a] + dx);
      store(block + (C::v + a) * kBlock, load(block + (C::v + a) * kBlock) + motion.dv[a]);
      change += motion.dv[a] * motion.dv[a];
      moved[a] = absolute(dx);
    }
    kinetic += select(real, change, Pack{});
    watch(result.ticks.gather);
    Pack A[Dim * Dim], middle[Dim * Dim];
    for (int k = 0; k < Dim * Dim; ++k) A[k] = step.dt * motion.L[k];
    advance_F<Dim>(A, F, middle);
    for (int k = 0; k < Dim * Dim; ++k) store(block + (C::F + k) * kBlock, F[k]);
    for (int a = 0; a < Dim; ++a) {  // 2 (F - middle) is the change of F
      for (int d = 0; d < Dim; ++d) moved[a] += 2 * body.reach[d] * absolute(F[a * Dim + d] - middle[a * Dim + d]);
      drift[a] = larger(drift[a], moved[a]);
    }
    Pack strain[6];
    strain_increment(A, middle, strain);
    const Pack J = determinant(F);
    Mask ok;
    Pack change_here;
    const Pack dissipation =
        body.condition
            ? update_conditioned<Dim>(body, step, b, strain, J, block, change_here, result.yielding, ok)
            : update_stress<Dim>(body, wood::AsMeasured<Pack>{}, strain, J, block, change_here, result.yielding, ok);
    plastic += select(real, dissipation, Pack{});
    stress_change += select(real, change_here, Pack{});
    if (any(~ok) && result.bad == 0) result.bad = b + 1;
    watch(result.ticks.material);
  }
  result.plastic += body.volume * sum(plastic);
  result.stress_change += 0.5 * body.volume * sum(stress_change);
  result.kinetic_change += 0.5 * body.mass * sum(kinetic);
  for (int a = 0; a < Dim; ++a) {
    const double d = largest(drift[a]) * step.inverse_cell[a];
    result.drift[a] = d > result.drift[a] ? d : result.drift[a];
  }
}

}  // namespace
}  // namespace strandlab::mpm::STRANDLAB_ISA
