// Contact of two bodies that meet alone at a node, eight nodes at a time.
#pragma once

#include "strandlab/mpm/kernels.hpp"
#include "strandlab/mpm/kernels/contact.hpp"
#include "strandlab/mpm/kernels/pack.hpp"

namespace strandlab::mpm::STRANDLAB_ISA {
namespace {

template <int Dim>
struct Encounters {
  int count = 0;
  double *a[kBlock], *b[kBlock];      // records of the two fields
  alignas(64) double n[Dim][kBlock];  // from a to b, not normalised
  alignas(64) double gap[kBlock];
};

template <int Dim>
STRANDLAB_INLINE void add(double* a, double* b, const Pair<Dim>& pair, Encounters<Dim>& e) {
  const int l = e.count++;
  e.a[l] = a;
  e.b[l] = b;
  for (int d = 0; d < Dim; ++d) e.n[d][l] = pair.n[d];
  e.gap[l] = pair.gap;
}

// contact_pass and resolve for one pair at each node, where one pass is exact.
template <int Dim>
STRANDLAB_INLINE void resolve(Encounters<Dim>& e, const Step<Dim>& step, double friction, PencilResult& result) {
  if (e.count == 0) return;
  const Pack zero{};
  Pack a[8], b[8], n[Dim], rel[Dim];
  Mask real;
  for (int l = 0; l < kBlock; ++l) {
    const int k = l < e.count ? l : 0;
    a[l] = load(e.a[k]);
    b[l] = load(e.b[k]);
    real[l] = l < e.count ? -1 : 0;
  }
  transpose(a);
  transpose(b);
  Pack size2{}, vn{};
  for (int d = 0; d < Dim; ++d) {
    n[d] = load(e.n[d]);
    size2 += n[d] * n[d];
  }
  const Pack inverse = 1.0 / square_root(select(real, size2, splat(1.0)));
  for (int d = 0; d < Dim; ++d) {
    n[d] = select(real, n[d] * inverse, zero);
    rel[d] = b[d] - a[d];
    vn += rel[d] * n[d];
  }
  const Pack target = select(real, -larger(load(e.gap), zero) / step.dt, zero);
  const Pack reduced = a[7] * b[7] / (a[7] + b[7]);
  const Pack normal = pushing(zero, vn, target, reduced);  // 0 where the lane is not real: there n is 0
  if (!any(normal > 0.0)) {
    e.count = 0;
    return;
  }
  Impulse<Dim, Pack> impulse{};
  Pack received[Dim];
  correct<Dim>(normal, rel, vn, n, reduced, friction, impulse, received);
  Pack contact{}, rubbed{}, kinetic{}, forces{};
  for (int d = 0; d < Dim; ++d) {
    const Pack change_a = -received[d] / a[7], change_b = received[d] / b[7];
    const Pack free_a = a[Dim + d], free_b = b[Dim + d];
    // Work on the mean relative velocity of the step: what the pair lost.
    const Pack mean = rel[d] + 0.5 * (change_b - free_b - change_a + free_a);
    contact += impulse.normal * n[d] * mean;
    rubbed += impulse.shear[d] * mean;
    kinetic += a[7] * change_a * (2.0 * free_a + change_a) + b[7] * change_b * (2.0 * free_b + change_b);
    forces += a[7] * change_a * free_a + b[7] * change_b * free_b;
    a[d] += change_a;
    b[d] += change_b;
    a[Dim + d] += change_a;
    b[Dim + d] += change_b;
  }
  result.contact -= sum(contact);
  result.friction -= sum(rubbed);
  result.kinetic_change += 0.5 * sum(select(real, kinetic, zero));
  result.force_change += 0.5 * sum(select(real, forces, zero));
  transpose(a);
  transpose(b);
  for (int l = 0; l < e.count; ++l) {
    store(e.a[l], a[l]);
    store(e.b[l], b[l]);
  }
  e.count = 0;
}

}  // namespace
}  // namespace strandlab::mpm::STRANDLAB_ISA
