// Contact at one node: pairs of opposed faces, of bodies and of bodies with platens, and the impulses between them.
#pragma once

#include "strandlab/mpm/kernels.hpp"
#include "strandlab/mpm/kernels/pack.hpp"

namespace strandlab::mpm::STRANDLAB_ISA {
namespace {

template <int Dim>
STRANDLAB_INLINE double dot(const double* a, const double* b) {
  double s = a[0] * b[0];
  for (int i = 1; i < Dim; ++i) s += a[i] * b[i];
  return s;
}

// The mean face of a field at a node: the plane that stands for all face points near it. `N` is the sum of their
// weighted areas along their outward normals, `W` the same without direction, so that |N| = W where the face is plane.
// `distance_W` is W times the distance from the node to the plane along N, positive where the node is inside.
template <int Dim>
struct NodeFace {
  const double* N;
  double W, size2, distance_W;
};

template <int Dim>
struct Meeting {  // a velocity field at a node where several meet
  double inverse_mass;
  double start[Dim];  // velocity at the start of the step, for the work of the impulses
  double trial[Dim];  // after forces, before contact
  double v[Dim];      // now
  double* record;
  int faces;
  NodeFace<Dim> face[kMaxFaces];
  int partners;
};

// What body a gives to body b at a node, N s (per mm of depth in 2D). T: one pair or a pack of them.
template <int Dim, class T>
struct Impulse {
  T normal;      // along n, compression positive
  T shear[Dim];  // in the plane of contact
};

// The normal part, `before` so far, with which the velocity `vn` at which b leaves a becomes `target`: it pushes or is
// zero. `reduced` is the mass that a pair moves against each other.
template <class T>
STRANDLAB_INLINE T pushing(const T& before, const T& vn, const T& target, const T& reduced) {
  return larger(before + reduced * (target - vn), T{});
}

// Gives an impulse its new normal part, and the shear that stops the relative velocity `rel` of b across n, within
// Coulomb friction. Returns in `change` what b receives on top of the impulse so far.
template <int Dim, class T>
STRANDLAB_INLINE void correct(const T& normal, const T (&rel)[Dim], const T& vn, const T (&n)[Dim], const T& reduced,
                              double friction, Impulse<Dim, T>& impulse, T (&change)[Dim]) {
  const T zero{};
  T shear[Dim], size2{};
  for (int d = 0; d < Dim; ++d) {
    shear[d] = impulse.shear[d] - reduced * (rel[d] - vn * n[d]);
    size2 += shear[d] * shear[d];
  }
  const T limit = friction * normal;
  const T scale = select(size2 > limit * limit, limit / square_root(larger(size2, zero + 1e-300)), zero + 1.0);
  for (int d = 0; d < Dim; ++d) {
    shear[d] *= scale;
    change[d] = (normal - impulse.normal) * n[d] + shear[d] - impulse.shear[d];
    impulse.shear[d] = shear[d];
  }
  impulse.normal = normal;
}

template <int Dim>
struct Pair {
  int a, b;
  double n[Dim];  // from a to b
  double gap;     // between the faces, negative where they overlap
  double target;  // separation velocity that just keeps the faces from crossing
  double friction;
  Impulse<Dim, double> impulse;  // so far
  double reduced;                // mass
};

template <int Dim>
STRANDLAB_INLINE void find_faces(const PencilField& field, unsigned faces, int row, double height,
                                 const Step<Dim>& step, const double* surface, Meeting<Dim>& m) {
  double x[Dim];  // the field's own node: on a periodic axis fields meet whose nodes lie whole periods apart
  for (int a = 0; a < Dim - 1; ++a) x[a] = step.origin[a] + field.index[a] * step.cell[a];
  x[Dim - 1] = height;
  m.faces = 0;
  for (; faces; faces &= faces - 1) {
    const int f = __builtin_ctz(faces);
    const double* s = surface + kSurfaceRecord<Dim> * static_cast<long>(field.face[f].base + row);
    const double W = s[Dim];
    if (!(W > 0)) continue;
    const double size2 = dot<Dim>(s, s);
    // Normals that cancel make no plane: |N| < W/2, as at an edge folded onto a symmetry plane. Judgement: two normals
    // 120 degrees apart have |N| = W/2.
    if (size2 < 0.25 * W * W) continue;
    m.face[m.faces++] = {s, W, size2, s[Dim + 1] - dot<Dim>(s, x)};
  }
}

// The pair of faces that separates two bodies: of those that oppose each other the one that is furthest apart. Faces
// oppose each other from 120 degrees between their normals on: judgement; 160 degrees loses contacts of tilted faces
// (tests/verification/contact/faces_test.cpp). Returns false if there is none or it is wider than `reach`. pair.n is
// not yet normalised: see finish_pair.
template <int Dim>
STRANDLAB_INLINE bool find_pair(const Meeting<Dim>& a, const Meeting<Dim>& b, double reach, Pair<Dim>& pair) {
  pair.gap = -1e300;
  const NodeFace<Dim>*best_a = nullptr, *best_b = nullptr;
  for (int i = 0; i < a.faces; ++i) {
    for (int j = 0; j < b.faces; ++j) {
      const NodeFace<Dim>&fa = a.face[i], &fb = b.face[j];
      const double d = dot<Dim>(fa.N, fb.N);
      if (d > 0 || d * d < 0.25 * fa.size2 * fb.size2) continue;
      const double gap = -(fa.distance_W * fb.W + fb.distance_W * fa.W) / (fa.W * fb.W);
      if (gap > pair.gap) {
        pair.gap = gap;
        best_a = &fa;
        best_b = &fb;
      }
    }
  }
  if (!best_a || pair.gap > reach) return false;
  for (int d = 0; d < Dim; ++d) pair.n[d] = best_a->N[d] * best_b->W - best_b->N[d] * best_a->W;
  return true;
}

// Overlap with a platen is pushed back: this part of it while a wave crosses a cell, and no more than the deepest one,
// in cells. Impulses stop the mean motion of the nodes, not the face itself, which would creep through over thousands
// of steps; returning so small an overlap so slowly gives back about a thousandth of the platens' work. Overlap between
// bodies stays: that of ends that met at speed would turn into elastic energy. Both numbers are judgement; other values
// have not been compared.
inline constexpr double kPlatenReturn = 0.05;
inline constexpr double kDeepestReturn = 0.1;

template <int Dim>
STRANDLAB_INLINE void finish_pair(const Step<Dim>& step, bool on_platen, Pair<Dim>& pair) {
  const double inverse = 1 / __builtin_sqrt(dot<Dim>(pair.n, pair.n));
  for (int d = 0; d < Dim; ++d) pair.n[d] *= inverse;
  const double deepest = kDeepestReturn * step.cell[Dim - 1];
  const double overlap = -pair.gap < deepest ? -pair.gap : deepest;
  pair.target = pair.gap > 0 ? -pair.gap / step.dt : on_platen ? kPlatenReturn * overlap / step.transit : 0.0;
}

// One pass over the pairs at a node, all from the same velocities: impulses so far are corrected towards
// [v].n >= target with a compressive impulse, and Coulomb friction. Masses are split among a body's partners
// (Tonge, Benevolenski & Voroshilov 2012), so that simultaneous corrections do not overshoot. Returns the largest
// change of velocity.
template <int Dim>
STRANDLAB_INLINE double contact_pass(Meeting<Dim>* m, int fields, Pair<Dim>* pairs, int count) {
  double change[3 * kMaxFields][Dim] = {};  // images among them
  for (int p = 0; p < count; ++p) {
    Pair<Dim>& pair = pairs[p];
    const Meeting<Dim>&a = m[pair.a], &b = m[pair.b];
    double rel[Dim], impulse[Dim];
    for (int d = 0; d < Dim; ++d) rel[d] = b.v[d] - a.v[d];
    const double vn = dot<Dim>(rel, pair.n);
    const double normal = pushing(pair.impulse.normal, vn, pair.target, pair.reduced);
    correct<Dim>(normal, rel, vn, pair.n, pair.reduced, pair.friction, pair.impulse, impulse);
    for (int d = 0; d < Dim; ++d) {
      change[pair.a][d] -= impulse[d] * a.inverse_mass;
      change[pair.b][d] += impulse[d] * b.inverse_mass;
    }
  }
  double largest = 0;
  for (int i = 0; i < fields; ++i) {
    double c2 = 0;
    for (int d = 0; d < Dim; ++d) {
      m[i].v[d] += change[i][d];
      c2 += change[i][d] * change[i][d];
    }
    largest = c2 > largest ? c2 : largest;
  }
  return __builtin_sqrt(largest);
}

// Parts of the first pass's largest change of velocity: nothing changes any more; and what the last pass allowed may
// still change without being counted. (On 40 mm of the OSB case 2 nodes a step change by more than the first after all
// passes, 1 in 1700 steps by more than the second.)
inline constexpr double kContactTolerance = 1e-6;
inline constexpr double kContactUnsettled = 1e-2;

// The impulses of all pairs at a node, then the velocities of its first `real` fields (images follow them) and the
// energies lost.
template <int Dim>
STRANDLAB_INLINE void resolve(Meeting<Dim>* m, int fields, int real, Pair<Dim>* pairs, int count, const Step<Dim>& step,
                              PencilResult& result) {
  for (int i = 0; i < fields; ++i) {
    m[i].inverse_mass = 1 / m[i].record[7];
    m[i].partners = 0;
    const bool image = i >= real;
    for (int d = 0; d < Dim; ++d) {
      const double sign = image && d < Dim - 1 ? -1 : 1;  // see has_mirror
      m[i].trial[d] = m[i].v[d] = sign * m[i].record[d];
      m[i].start[d] = sign * (m[i].record[d] - m[i].record[Dim + d]);
    }
  }
  for (int p = 0; p < count; ++p) {
    finish_pair<Dim>(step, pairs[p].b >= real, pairs[p]);
    ++m[pairs[p].a].partners;
    ++m[pairs[p].b].partners;
    pairs[p].impulse = {};
  }
  for (int p = 0; p < count; ++p) {
    const Meeting<Dim>&a = m[pairs[p].a], &b = m[pairs[p].b];
    pairs[p].reduced = 1 / (a.partners * a.inverse_mass + b.partners * b.inverse_mass);
  }
  double first = 0, last = 0;                          // change of velocity in a pass
  const int passes = count == 1 ? 1 : kContactPasses;  // for one pair one pass is exact
  for (int k = 0; k < passes; ++k) {
    last = contact_pass<Dim>(m, fields, pairs, count);
    if (k == 0) first = last;
    if (last <= kContactTolerance * first) break;
  }
  if (count > 1 && last > kContactUnsettled * first) ++result.unconverged;
  // Work of each impulse on the mean relative velocity of the step (all its forces included): what the pair lost.
  for (int p = 0; p < count; ++p) {
    const Pair<Dim>& pair = pairs[p];
    const Meeting<Dim>&a = m[pair.a], &b = m[pair.b];
    const bool on_platen = pair.b >= real;
    const int k = pair.n[Dim - 1] > 0;
    double mean[Dim];
    for (int d = 0; d < Dim; ++d) {
      const double other = !on_platen ? 0.5 * (b.v[d] + b.start[d]) : d == Dim - 1 ? step.platen[k].velocity : 0.0;
      mean[d] = other - 0.5 * (a.v[d] + a.start[d]);
    }
    result.contact -= pair.impulse.normal * dot<Dim>(mean, pair.n);
    result.friction -= dot<Dim>(pair.impulse.shear, mean);
    if (on_platen) {
      result.platen_impulse[k] += pair.impulse.normal;
      result.platen_work -= pair.impulse.normal * pair.n[Dim - 1] * step.platen[k].velocity;
    }
  }
  for (int i = 0; i < real; ++i) {
    const double half_mass = 0.5 * m[i].record[7];
    for (int d = 0; d < Dim; ++d) {
      const double change = m[i].v[d] - m[i].trial[d], free = m[i].record[Dim + d];
      result.kinetic_change += half_mass * change * (2 * free + change);  // momentum_balance booked dv = free
      result.force_change += half_mass * change * free;
      m[i].record[d] = m[i].v[d];
      m[i].record[Dim + d] = free + change;
    }
  }
}

// The mirror image of a field in platen k; false where it has no mass. Its nodes move along with the body in the plane
// of the platen and against it through the thickness. In contact its motion in the plane counts reversed: then a pair
// that sticks stands still, as on a rigid wall, and one that slides feels no more friction than the law allows.
template <int Dim>
STRANDLAB_INLINE bool has_mirror(const PencilField& field, int k, int row, const GridView<Dim>& grid, Meeting<Dim>& m) {
  if (row < field.mirror[k].row_lo || row >= field.mirror[k].row_hi) return false;
  m.record = grid.nodes + kRecord * static_cast<long>(field.mirror[k].base + row);
  return m.record[7] > 0;
}

// Contact of a field with platen k: the pair of the field (a) and its image (b), which is twice as far from it as the
// wall. Of the faces that look at the wall, by 60 degrees or less, the one furthest from it counts: at a strand's end
// two of them meet, the body lies behind both, and the plane of each goes on where there is no body.
template <int Dim>
STRANDLAB_INLINE bool platen_pair(const Meeting<Dim>& field, const Step<Dim>& step, int k, double node_height,
                                  double reach, Pair<Dim>& pair) {
  const double direction = k == 0 ? -1 : 1;  // from the field to the platen
  pair.gap = -1e300;
  for (int f = 0; f < field.faces; ++f) {
    const NodeFace<Dim>& face = field.face[f];
    const double along = face.N[Dim - 1] * direction;
    if (along < 0 || along * along < 0.25 * face.size2) continue;
    const double to_wall =
        (step.platen[k].position - node_height) * direction - face.distance_W * along / (face.W * face.W);
    pair.gap = 2 * to_wall > pair.gap ? 2 * to_wall : pair.gap;
  }
  if (pair.gap < -1e299 || pair.gap > reach) return false;
  for (int d = 0; d < Dim; ++d) pair.n[d] = 0;
  pair.n[Dim - 1] = direction;
  return true;
}

}  // namespace
}  // namespace strandlab::mpm::STRANDLAB_ISA
