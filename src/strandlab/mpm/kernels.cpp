// Particles to grid, grid update with contact, grid to particles: see kernels.hpp. Compiled once per instruction set
// with STRANDLAB_ISA naming the build.
#include "strandlab/mpm/kernels.hpp"

#include <time.h>

#include "strandlab/mpm/pack.hpp"

namespace strandlab::mpm::STRANDLAB_ISA {
namespace {

// A cheap clock for profiling: ticks of constant rate, converted to seconds by the engine.
STRANDLAB_INLINE double now() {
#if defined(__x86_64__)
  return static_cast<double>(__builtin_ia32_rdtsc());
#else
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
#endif
}

// Adds the time since the last lap to a total, when profiling.
struct Lap {
  bool on;
  double t;
  explicit Lap(bool profile) : on(profile), t(profile ? now() : 0) {}
  STRANDLAB_INLINE void operator()(double& total) {
    if (!on) return;
    const double s = now();
    total += s - t;
    t = s;
  }
};

// GIMP weights and gradients of eight particles: three nodes per axis around the nearest node.
template <int Dim>
struct Stencil {
  alignas(64) double w[Dim][3][kBlock];
  alignas(64) double g[Dim][3][kBlock];  // 1/mm
  alignas(64) long long node[Dim][kBlock];
};

// Bardenhagen & Kober (2004): the mean of a hat function over the particle's domain, half-width r cells, at distance d
// from the nearest node. Over the right neighbour's hat max(xi, 0) the mean on [d - r, d + r] is (u1^2 - u0^2)/(4r).
STRANDLAB_INLINE void gimp_axis(const Pack& d, const Pack& r, double inverse_cell, double (&w)[3][kBlock],
                                double (&g)[3][kBlock]) {
  const Pack zero{};
  const Pack half_over_r = 0.5 / r;
  const Pack u1 = larger(d + r, zero), u0 = larger(d - r, zero);
  const Pack l1 = larger(r - d, zero), l0 = larger(-d - r, zero);
  const Pack gr = (u1 - u0) * half_over_r;
  const Pack gl = (l1 - l0) * half_over_r;
  const Pack wr = 0.5 * gr * (u1 + u0);
  const Pack wl = 0.5 * gl * (l1 + l0);
  store(w[0], wl);
  store(w[1], 1.0 - wl - wr);
  store(w[2], wr);
  store(g[0], -gl * inverse_cell);
  store(g[1], (gl - gr) * inverse_cell);
  store(g[2], gr * inverse_cell);
}

template <int Dim>
STRANDLAB_INLINE void stencil_at(const Pack (&x)[Dim], const Pack (&stretch)[Dim], const double* half_size,
                                 const Frame<Dim>& frame, Stencil<Dim>& s) {
  for (int a = 0; a < Dim; ++a) {
    const Pack xi = (x[a] - frame.origin[a]) * frame.inverse_cell[a];
    const Pack rounded = shifted(xi);
    const Mask node = bits(rounded);
    __builtin_memcpy(s.node[a], &node, sizeof node);
    const Pack r =
        smaller(larger(absolute(stretch[a]) * (half_size[a] * frame.inverse_cell[a]), splat(1e-3)), splat(0.5));
    gimp_axis(xi - (rounded - kRounder), r, frame.inverse_cell[a], s.w[a], s.g[a]);
  }
}

// Records of the first row of a lane's stencil on each of its 3 (2D) or 9 (3D) pencils.
template <int Dim>
STRANDLAB_INLINE void pencil_records(const Window& window, const Stencil<Dim>& s, int lane,
                                     int (&record)[Dim == 2 ? 3 : 9]) {
  const int row = static_cast<int>(s.node[Dim - 1][lane]) - 1;
  const int c0 = static_cast<int>(s.node[0][lane]) - 1 - window.first[0];
  if constexpr (Dim == 2) {
    for (int i = 0; i < 3; ++i) record[i] = window.base[c0 + i] + row;
  } else {
    const int c1 = static_cast<int>(s.node[1][lane]) - 1 - window.first[1];
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) record[3 * k + i] = window.base[(c1 + k) * window.count[0] + c0 + i] + row;
    }
  }
}

// Weight of a pencil for a lane and its lateral gradients.
template <int Dim>
STRANDLAB_INLINE double pencil_weight(const Stencil<Dim>& s, int q, int lane) {
  if constexpr (Dim == 2)
    return s.w[0][q][lane];
  else
    return s.w[0][q % 3][lane] * s.w[1][q / 3][lane];
}
template <int Dim>
STRANDLAB_INLINE double pencil_gradient(const Stencil<Dim>& s, int axis, int q, int lane) {
  if constexpr (Dim == 2)
    return s.g[0][q][lane];
  else
    return axis == 0 ? s.g[0][q % 3][lane] * s.w[1][q / 3][lane] : s.w[0][q % 3][lane] * s.g[1][q / 3][lane];
}
template <int Dim>
inline constexpr int kPencils = Dim == 2 ? 3 : 9;

// Asks for the next block while this one is worked on; a block is too long for the hardware to see the stream.
STRANDLAB_INLINE void prefetch(const double* block, long stride) {
  for (long i = 0; i < stride; i += kBlock) __builtin_prefetch(block + stride + i);
}

template <int N>
STRANDLAB_INLINE void load_packs(const double* from, Pack (&to)[N]) {
  for (int i = 0; i < N; ++i) to[i] = load(from + i * kBlock);
}
template <int Dim>
STRANDLAB_INLINE void diagonal(const Pack (&F)[Dim * Dim], Pack (&d)[Dim]) {
  for (int a = 0; a < Dim; ++a) d[a] = F[a * Dim + a];
}

// The strand's axes in the current state: along = F a0/|F a0|, thickness perpendicular to it (in 3D: also to the
// material line across), across completes the right-handed frame. F is row-major. axes[k] are the directions 1 = along,
// 2 = across, 3 = thickness.
STRANDLAB_INLINE void strand_axes(const Pack (&F)[4], Pack (&along)[2]) {
  const Pack s = 1.0 / square_root(F[0] * F[0] + F[2] * F[2]);
  along[0] = F[0] * s;
  along[1] = F[2] * s;
}
STRANDLAB_INLINE void strand_axes(const Pack (&F)[9], Pack (&e)[3][3]) {
  const Pack s = 1.0 / square_root(F[0] * F[0] + F[3] * F[3] + F[6] * F[6]);
  for (int a = 0; a < 3; ++a) e[0][a] = F[3 * a] * s;
  // thickness ~ along x (F across); across = thickness x along
  const Pack c[3] = {F[1], F[4], F[7]};
  Pack t[3] = {e[0][1] * c[2] - e[0][2] * c[1], e[0][2] * c[0] - e[0][0] * c[2], e[0][0] * c[1] - e[0][1] * c[0]};
  const Pack u = 1.0 / square_root(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
  for (int a = 0; a < 3; ++a) e[2][a] = t[a] * u;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, d = (a + 2) % 3;
    e[1][a] = e[2][b] * e[0][d] - e[2][d] * e[0][b];
  }
}

// Kirchhoff stress in panel axes, times volume: (xx, xy, yy) or (xx, yy, zz, yz, xz, xy).
STRANDLAB_INLINE void panel_stress(const Pack (&F)[4], const Pack* tau, double volume, Pack (&s)[3]) {
  Pack a[2];
  strand_axes(F, a);
  const Pack cc = a[0] * a[0], ss = a[1] * a[1], cs = a[0] * a[1];
  const Pack t11 = tau[0] * volume, t33 = tau[2] * volume, t13 = tau[3] * volume;
  s[0] = cc * t11 + ss * t33 - 2.0 * cs * t13;
  s[1] = cs * (t11 - t33) + (cc - ss) * t13;
  s[2] = ss * t11 + cc * t33 + 2.0 * cs * t13;
}
STRANDLAB_INLINE void panel_stress(const Pack (&F)[9], const Pack* tau, double volume, Pack (&s)[6]) {
  Pack e[3][3];
  strand_axes(F, e);
  // tau components: 11, 22, 33, 13, 23, 12
  const Pack T[3][3] = {{tau[0] * volume, tau[5] * volume, tau[3] * volume},
                        {tau[5] * volume, tau[1] * volume, tau[4] * volume},
                        {tau[3] * volume, tau[4] * volume, tau[2] * volume}};
  Pack half[3][3];  // T e
  for (int k = 0; k < 3; ++k) {
    for (int b = 0; b < 3; ++b) half[k][b] = T[k][0] * e[0][b] + T[k][1] * e[1][b] + T[k][2] * e[2][b];
  }
  const auto component = [&](int a, int b) {
    return e[0][a] * half[0][b] + e[1][a] * half[1][b] + e[2][a] * half[2][b];
  };
  s[0] = component(0, 0);
  s[1] = component(1, 1);
  s[2] = component(2, 2);
  s[3] = component(1, 2);
  s[4] = component(0, 2);
  s[5] = component(0, 1);
}

// ---------------------------------------------------------------------------------------------- particles to grid

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

STRANDLAB_INLINE void scatter_lane(const Rows<2>& r, const Stencil<2>& s, const Window& window, int l, double* nodes) {
  const Pack zero{};
  const Pack momentum = __builtin_shufflevector(r.row[l], zero, 0, 1, 2, 8, 8, 8, 8, 8);
  const Pack column_x = __builtin_shufflevector(r.row[l], zero, 8, 8, 8, 3, 4, 8, 8, 8);
  const Pack column_y = __builtin_shufflevector(r.row[l], zero, 8, 8, 8, 4, 5, 8, 8, 8);
  int record[3];
  pencil_records<2>(window, s, l, record);
  for (int q = 0; q < 3; ++q) {
    const double wx = s.w[0][q][l];
    const Pack by_weight = momentum * wx + column_x * s.g[0][q][l];
    const Pack by_gradient = column_y * wx;
    double* node = nodes + kRecord * static_cast<long>(record[q]);
    for (int j = 0; j < 3; ++j) add(node + kRecord * j, by_weight * s.w[1][j][l] + by_gradient * s.g[1][j][l]);
  }
}
STRANDLAB_INLINE void scatter_lane(const Rows<3>& r, const Stencil<3>& s, const Window& window, int l, double* nodes) {
  const Pack zero{};
  const Pack& momentum = r.row[l];
  const Pack column_x = __builtin_shufflevector(r.stress[l], zero, 8, 8, 8, 8, 0, 5, 4, 8);
  const Pack column_y = __builtin_shufflevector(r.stress[l], zero, 8, 8, 8, 8, 5, 1, 3, 8);
  const Pack column_z = __builtin_shufflevector(r.stress[l], zero, 8, 8, 8, 8, 4, 3, 2, 8);
  int record[9];
  pencil_records<3>(window, s, l, record);
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
                                     const Pack (&tau)[6], const BodyView<Dim>& body, const Frame<Dim>& frame, int k,
                                     int lanes, double* nodes) {
  constexpr int y = Dim - 1;
  const Pack depth = absolute(x[y] - frame.platen[k].position) * frame.inverse_cell[y];
  const Mask close = depth < kMirrorDepth;
  if (!any(close)) return;
  Pack mx[Dim], mv[Dim], mF[Dim * Dim], stretch[Dim], mtau[6];
  for (int a = 0; a < Dim; ++a) {
    mx[a] = a == y ? 2 * frame.platen[k].position - x[a] : x[a];
    mv[a] = a == y ? 2 * frame.platen[k].velocity - v[a] : v[a];
    for (int b = 0; b < Dim; ++b) mF[a * Dim + b] = (a == y) == (b == y) ? F[a * Dim + b] : -F[a * Dim + b];
  }
  for (int c = 0; c < (Dim == 2 ? 4 : 6); ++c) mtau[c] = c == 3 || c == 4 ? -tau[c] : tau[c];  // 13 and 23 change sign
  diagonal<Dim>(mF, stretch);
  Stencil<Dim> s;
  stencil_at<Dim>(mx, stretch, body.half_size, frame, s);
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
                                      const Frame<Dim>& frame, double* surface) {
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
  Pack stretch[Dim], N[Dim];
  diagonal<Dim>(F, stretch);
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
  stencil_at<Dim>(x, stretch, body.half_size, frame, s);
  Pack row[8] = {};
  for (int a = 0; a < Dim; ++a) row[a] = N[a];
  row[Dim] = square_root(size2);
  row[Dim + 1] = along;
  transpose(row);
  for (int l = 0; l < kBlock; ++l) {
    if (row[l][Dim] == 0) continue;  // padding
    int record[kPencils<Dim>];
    pencil_records<Dim>(face.window, s, l, record);
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
void scatter(const Tile& tile, const BodyView<Dim>& body, const Frame<Dim>& frame, double* nodes, double* surface,
             const unsigned char* lanes, bool profile, TileResult& result) {
  using C = Component<Dim>;
  Lap lap(profile);
  const long stride = static_cast<long>(C::count(body.components)) * kBlock;
  for (int b = tile.block_begin; b < tile.block_end; ++b) {
    const double* block = body.blocks + b * stride;
    prefetch(block, stride);
    Pack x[Dim], v[Dim], F[Dim * Dim], tau[6], stretch[Dim];
    load_packs(block, x);
    load_packs(block + C::v * kBlock, v);
    load_packs(block + C::F * kBlock, F);
    for (int k = 0; k < (Dim == 2 ? 4 : 6); ++k) tau[k] = load(block + (C::stress + k) * kBlock);
    diagonal<Dim>(F, stretch);
    Stencil<Dim> s;
    stencil_at<Dim>(x, stretch, body.half_size, frame, s);
    lap(result.ticks[0]);
    Rows<Dim> rows;
    prepare(v, F, tau, body.mass, body.volume, rows);
    for (int l = 0; l < lanes[b]; ++l) scatter_lane(rows, s, body.window, l, nodes);
    for (int k = 0; k < 2; ++k) {
      if (body.mirror[k].height > 0) scatter_mirror<Dim>(x, v, F, tau, body, frame, k, lanes[b], nodes);
    }
    lap(result.ticks[1]);
  }
  for (int f = 0; f < body.faces; ++f) {
    for (int p = tile.face_begin[f]; p < tile.face_end[f]; ++p)
      scatter_surface<Dim>(body.face[f], p, body, frame, surface);
  }
  lap(result.ticks[2]);
}

// ---------------------------------------------------------------------------------------------- grid and contact

template <int Dim>
STRANDLAB_INLINE double dot(const double* a, const double* b) {
  double s = a[0] * b[0];
  for (int i = 1; i < Dim; ++i) s += a[i] * b[i];
  return s;
}

// One face of a field at a node: area-weighted outward normal N = W n, and W times the signed distance from the node to
// the face along it.
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

template <int Dim>
struct Pair {
  int a, b;
  double n[Dim];  // from a to b
  double gap;     // between the faces, negative where they overlap
  double target;  // separation velocity that just keeps the faces from crossing
  double friction;
  double normal;  // impulse so far, compression positive
  double shear[Dim];
  double reduced;  // mass
};

template <int Dim>
STRANDLAB_INLINE void find_faces(const PencilField& field, unsigned faces, int row, const double* x,
                                 const double* surface, Meeting<Dim>& m) {
  m.faces = 0;
  for (; faces; faces &= faces - 1) {
    const int f = __builtin_ctz(faces);
    const double* s = surface + kSurfaceRecord<Dim> * static_cast<long>(field.face[f].base + row);
    const double W = s[Dim];
    if (!(W > 0)) continue;
    const double size2 = dot<Dim>(s, s);
    if (size2 < 0.25 * W * W) continue;  // normals cancel: an edge folded onto a symmetry plane
    m.face[m.faces++] = {s, W, size2, s[Dim + 1] - dot<Dim>(s, x)};
  }
}

// Of all pairs of faces that oppose each other (by more than 120 degrees) the one that is furthest apart separates the
// bodies. Returns false if there is none or the gap is too wide to close in a step. pair.n is not yet normalised: see
// finish_pair.
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

// Part of an overlap that is pushed back while a wave crosses a cell, and the deepest overlap that counts, in cells. At
// a platen the impulses stop the mean motion of the nodes, not the face itself, which would creep through over
// thousands of steps; returning so small an overlap so slowly costs no energy worth the name. Between bodies none is
// pushed back: overlaps of ends that met at speed would turn into elastic energy.
inline constexpr double kPlatenReturn = 0.05;
inline constexpr double kDeepestReturn = 0.1;

template <int Dim>
STRANDLAB_INLINE void finish_pair(const Frame<Dim>& frame, bool on_platen, Pair<Dim>& pair) {
  const double inverse = 1 / __builtin_sqrt(dot<Dim>(pair.n, pair.n));
  for (int d = 0; d < Dim; ++d) pair.n[d] *= inverse;
  const double deepest = kDeepestReturn * frame.cell[Dim - 1];
  const double overlap = -pair.gap < deepest ? -pair.gap : deepest;
  pair.target = pair.gap > 0 ? -pair.gap / frame.dt : on_platen ? kPlatenReturn * overlap / frame.transit : 0.0;
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
    double rel[Dim];
    for (int d = 0; d < Dim; ++d) rel[d] = b.v[d] - a.v[d];
    const double vn = dot<Dim>(rel, pair.n);
    double normal = pair.normal + pair.reduced * (pair.target - vn);
    normal = normal > 0 ? normal : 0;
    double shear[Dim], size2 = 0;
    for (int d = 0; d < Dim; ++d) {
      shear[d] = pair.shear[d] - pair.reduced * (rel[d] - vn * pair.n[d]);
      size2 += shear[d] * shear[d];
    }
    const double limit = pair.friction * normal;
    const double scale = size2 > limit * limit ? limit / __builtin_sqrt(size2) : 1;
    for (int d = 0; d < Dim; ++d) {
      shear[d] *= scale;
      const double dJ = (normal - pair.normal) * pair.n[d] + shear[d] - pair.shear[d];
      change[pair.a][d] -= dJ * a.inverse_mass;
      change[pair.b][d] += dJ * b.inverse_mass;
      pair.shear[d] = shear[d];
    }
    pair.normal = normal;
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

// The impulses of all pairs at a node, then the velocities of its first `real` fields (images follow them) and the
// energies lost.
template <int Dim>
STRANDLAB_INLINE void resolve(Meeting<Dim>* m, int fields, int real, Pair<Dim>* pairs, int count,
                              const Frame<Dim>& frame, PencilResult& result) {
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
    finish_pair<Dim>(frame, pairs[p].b >= real, pairs[p]);
    ++m[pairs[p].a].partners;
    ++m[pairs[p].b].partners;
    pairs[p].normal = 0;
    for (int d = 0; d < Dim; ++d) pairs[p].shear[d] = 0;
  }
  for (int p = 0; p < count; ++p) {
    const Meeting<Dim>&a = m[pairs[p].a], &b = m[pairs[p].b];
    pairs[p].reduced = 1 / (a.partners * a.inverse_mass + b.partners * b.inverse_mass);
  }
  const int passes = count == 1 ? 1 : 40;
  double first = 0;
  for (int k = 0; k < passes; ++k) {
    const double change = contact_pass<Dim>(m, fields, pairs, count);
    if (k == 0) first = change;
    if (change <= 1e-6 * first) break;
  }
  // Work of each impulse on the mean relative velocity of the step (all its forces included): what the pair lost.
  for (int p = 0; p < count; ++p) {
    const Pair<Dim>& pair = pairs[p];
    const Meeting<Dim>&a = m[pair.a], &b = m[pair.b];
    const bool on_platen = pair.b >= real;
    const int k = pair.n[Dim - 1] > 0;
    double mean[Dim];
    for (int d = 0; d < Dim; ++d) {
      const double other = !on_platen ? 0.5 * (b.v[d] + b.start[d]) : d == Dim - 1 ? frame.platen[k].velocity : 0.0;
      mean[d] = other - 0.5 * (a.v[d] + a.start[d]);
    }
    result.contact -= pair.normal * dot<Dim>(mean, pair.n);
    result.friction -= dot<Dim>(pair.shear, mean);
    if (on_platen) {
      result.platen_impulse[k] += pair.normal;
      result.platen_work -= pair.normal * pair.n[Dim - 1] * frame.platen[k].velocity;
    }
  }
  for (int i = 0; i < real; ++i) {
    const double half_mass = 0.5 * m[i].record[7];
    for (int d = 0; d < Dim; ++d) {
      const double change = m[i].v[d] - m[i].trial[d], free = m[i].record[Dim + d];
      result.kinetic_change += half_mass * change * (2 * free + change);  // momentum_balance booked dv = free
      result.force_change += half_mass * change * free;
      result.external_work += 2 * half_mass * frame.dt * frame.gravity[d] * change;
      m[i].record[d] = m[i].v[d];
      m[i].record[Dim + d] = free + change;
    }
  }
}

// The mirror image of a field in platen k; false where it has no mass. In contact its tangential motion counts
// reversed, so that a pair that sticks stops at the wall while one that slides feels only the friction allowed.
template <int Dim>
STRANDLAB_INLINE bool has_mirror(const PencilField& field, int k, int row, const GridView<Dim>& grid, Meeting<Dim>& m) {
  if (row < field.mirror[k].row_lo || row >= field.mirror[k].row_hi) return false;
  m.record = grid.nodes + kRecord * static_cast<long>(field.mirror[k].base + row);
  return m.record[7] > 0;
}

// Contact of a field with platen k: the pair of the field (a) and its image (b). The gap to the image is twice that to
// the wall. Of the faces that look at the wall the one furthest from it counts: where two of them meet, at a strand's
// end, the body lies behind both, and the plane of one reaches beyond the body.
template <int Dim>
STRANDLAB_INLINE bool platen_pair(const Meeting<Dim>& field, const Frame<Dim>& frame, int k, double node_height,
                                  double reach, Pair<Dim>& pair) {
  const double direction = k == 0 ? -1 : 1;  // from the field to the platen
  pair.gap = -1e300;
  for (int f = 0; f < field.faces; ++f) {
    const NodeFace<Dim>& face = field.face[f];
    const double along = face.N[Dim - 1] * direction;
    if (along < 0 || along * along < 0.25 * face.size2) continue;
    const double to_wall =
        (frame.platen[k].position - node_height) * direction - face.distance_W * along / (face.W * face.W);
    pair.gap = 2 * to_wall > pair.gap ? 2 * to_wall : pair.gap;
  }
  if (pair.gap < -1e299 || pair.gap > reach) return false;
  for (int d = 0; d < Dim; ++d) pair.n[d] = 0;
  pair.n[Dim - 1] = direction;
  return true;
}

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

// What a record is multiplied with and what is added to it: {v, dv} = scale {p, f}/m + gravity.
struct NodeUpdate {
  Pack scale, gravity;
};
// On a roller plane the normal component is zero. A mirror image feels gravity reversed.
template <int Dim>
STRANDLAB_INLINE NodeUpdate node_update(const Pencil& pencil, const Frame<Dim>& frame, double gravity_sign) {
  NodeUpdate u{};
  for (int d = 0; d < Dim; ++d) {
    const bool on_wall = d < Dim - 1 && (pencil.index[d] == frame.wall[d][0] || pencil.index[d] == frame.wall[d][1]);
    if (on_wall) continue;
    u.scale[d] = 1;
    u.scale[Dim + d] = frame.dt;
    u.gravity[Dim + d] = frame.dt * frame.gravity[d] * (d == Dim - 1 ? gravity_sign : 1);
  }
  return u;
}

// v = p/m + dv, dv = dt f/m + dt g: the record becomes {v, dv, ..., m}. Returns sum m {v^2, dv^2} of the nodes and adds
// sum m {v, dv} to `momentum`.
template <int Dim>
STRANDLAB_INLINE Pack advance_nodes(const PencilField::Rows& rows, const NodeUpdate& update, double* nodes,
                                    Pack& momentum) {
  Pack squares{};
  double* r = nodes + kRecord * static_cast<long>(rows.base + rows.row_lo);
  for (int row = rows.row_lo; row < rows.row_hi; ++row, r += kRecord) {
    const Pack record = load(r);
    const double mass = record[0];
    const double inverse = mass > 0 ? 1 / mass : 0;
    const Pack before =
        momentum_and_force<Dim>(record) * inverse * update.scale + (mass > 0 ? 1.0 : 0.0) * update.gravity;
    Pack after = before + second_vector<Dim>(before);
    momentum += mass * after;
    squares += mass * after * after;
    after[7] = mass;
    store(r, after);
  }
  return squares;
}

// Momentum balance at the nodes of a field and of its mirror images on a pencil, and its energies before contact: 1/2
// sum m |dv|^2, of which lumping the mass costs a part when the particles take up dv, and the work of gravity on the
// step's mean velocity.
template <int Dim>
STRANDLAB_INLINE void momentum_balance(const PencilField& field, const NodeUpdate& update,
                                       const NodeUpdate& image_update, const Frame<Dim>& frame,
                                       const GridView<Dim>& grid, PencilResult& result) {
  Pack momentum{}, ignored{};
  const Pack squares = advance_nodes<Dim>({field.base, field.row_lo, field.row_hi}, update, grid.nodes, momentum);
  for (int k = 0; k < 2; ++k) advance_nodes<Dim>(field.mirror[k], image_update, grid.nodes, ignored);
  for (int d = 0; d < Dim; ++d) {
    result.kinetic_change += 0.5 * squares[Dim + d];
    result.force_change += 0.5 * squares[Dim + d];
    result.external_work += momentum[d] * frame.dt * frame.gravity[d];
  }
}

// Pairs of bodies that meet alone at a node, eight at a time.
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
STRANDLAB_INLINE void resolve(Encounters<Dim>& e, const Frame<Dim>& frame, double friction, PencilResult& result) {
  if (e.count == 0) return;
  const Pack zero{};
  Pack a[8], b[8], n[Dim], rel[Dim], shear[Dim];
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
  const Pack target = select(real, -larger(load(e.gap), zero) / frame.dt, zero);
  const Pack reduced = a[7] * b[7] / (a[7] + b[7]);
  const Pack normal = select(real, larger(reduced * (target - vn), zero), zero);
  if (!any(normal > 0.0)) {
    e.count = 0;
    return;
  }
  size2 = zero;
  for (int d = 0; d < Dim; ++d) {
    shear[d] = -reduced * (rel[d] - vn * n[d]);
    size2 += shear[d] * shear[d];
  }
  const Pack limit = friction * normal;
  const Pack scale = select(size2 > limit * limit, limit / square_root(larger(size2, splat(1e-300))), splat(1.0));
  Pack contact{}, rubbed{}, kinetic{}, forces{}, gravity{};
  for (int d = 0; d < Dim; ++d) {
    shear[d] *= scale;
    const Pack impulse = normal * n[d] + shear[d];
    const Pack change_a = -impulse / a[7], change_b = impulse / b[7];
    const Pack free_a = a[Dim + d], free_b = b[Dim + d];
    // Work on the mean relative velocity of the step: what the pair lost.
    const Pack mean = rel[d] + 0.5 * (change_b - free_b - change_a + free_a);
    contact += normal * n[d] * mean;
    rubbed += shear[d] * mean;
    kinetic += a[7] * change_a * (2.0 * free_a + change_a) + b[7] * change_b * (2.0 * free_b + change_b);
    forces += a[7] * change_a * free_a + b[7] * change_b * free_b;
    gravity += frame.gravity[d] * (a[7] * change_a + b[7] * change_b);
    a[d] += change_a;
    b[d] += change_b;
    a[Dim + d] += change_a;
    b[Dim + d] += change_b;
  }
  result.contact -= sum(contact);
  result.friction -= sum(rubbed);
  result.kinetic_change += 0.5 * sum(select(real, kinetic, zero));
  result.force_change += 0.5 * sum(select(real, forces, zero));
  result.external_work += frame.dt * sum(select(real, gravity, zero));
  transpose(a);
  transpose(b);
  for (int l = 0; l < e.count; ++l) {
    store(e.a[l], a[l]);
    store(e.b[l], b[l]);
  }
  e.count = 0;
}

// Contact at the nodes of one row of a pencil, momentum conserving, independent of the order of the bodies. Two bodies
// that meet far from the platens are put into `encounters`, for later.
template <int Dim>
STRANDLAB_INLINE void contact_row(const Pencil& pencil, int row, double* x, const Frame<Dim>& frame,
                                  const GridView<Dim>& grid, Encounters<Dim>& encounters, PencilResult& result) {
  const double cell = frame.cell[Dim - 1], reach = 0.25 * cell;
  const int begin = grid.row_start[pencil.slots + row - pencil.row_lo];
  const int end = grid.row_start[pencil.slots + row - pencil.row_lo + 1];
  x[Dim - 1] = frame.origin[Dim - 1] + row * cell;
  bool platen[2];
  for (int k = 0; k < 2; ++k) {
    platen[k] = frame.platen[k].present && (frame.platen[k].position - x[Dim - 1]) * (k == 0 ? -1 : 1) < 1.5 * cell;
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
      result.overflow = 1;
      break;
    }
    m[fields].record = record;
    origin[fields++] = &grid.slots[s];
  }
  if (fields < least) return;
  const int real = fields;
  const auto field_of = [&](int i) -> const PencilField& { return grid.fields[pencil.field_begin + origin[i]->field]; };
  for (int i = 0; i < real; ++i) find_faces<Dim>(field_of(i), origin[i]->faces, row, x, grid.surface, m[i]);
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
      if (!platen[k] || !platen_pair<Dim>(m[i], frame, k, x[Dim - 1], reach, pair)) continue;
      if (!has_mirror<Dim>(field_of(i), k, row, grid, m[fields])) continue;
      pair.a = i;
      pair.b = fields++;
      pair.friction = grid.platen_friction;
      ++count;
    }
  }
  if (count > 0) resolve<Dim>(m, fields, real, pairs, count, frame, result);
}

template <int Dim>
void update_grid(const Pencil& pencil, const Frame<Dim>& frame, const GridView<Dim>& grid, bool profile,
                 PencilResult& result) {
  if (pencil.ghost) return;
  const NodeUpdate update = node_update<Dim>(pencil, frame, 1), image_update = node_update<Dim>(pencil, frame, -1);
  for (int f = pencil.field_begin; f < pencil.field_end; ++f)
    momentum_balance<Dim>(grid.fields[f], update, image_update, frame, grid, result);
  Lap lap(profile);
  double x[Dim];
  for (int a = 0; a < Dim - 1; ++a) x[a] = frame.origin[a] + pencil.index[a] * frame.cell[a];
  Encounters<Dim> encounters;
  for (int row = pencil.row_lo; row < pencil.row_hi; ++row) {
    contact_row<Dim>(pencil, row, x, frame, grid, encounters, result);
    if (encounters.count == kBlock) resolve<Dim>(encounters, frame, grid.friction, result);
  }
  resolve<Dim>(encounters, frame, grid.friction, result);
  lap(result.contact_ticks);
}

// ---------------------------------------------------------------------------------------------- grid to particles

// Velocity, its change and its gradient at eight particles.
template <int Dim>
struct Motion {
  Pack v[Dim], dv[Dim];
  Pack L[Dim * Dim];  // dv_i/dx_j, row-major
};

STRANDLAB_INLINE void gather_motion(const Stencil<2>& s, const Window& window, const double* nodes, int lanes,
                                    Motion<2>& m) {
  Pack row[8] = {};
  for (int l = 0; l < lanes; ++l) {
    int record[3];
    pencil_records<2>(window, s, l, record);
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

STRANDLAB_INLINE void gather_motion(const Stencil<3>& s, const Window& window, const double* nodes, int lanes,
                                    Motion<3>& m) {
  Pack value[8] = {}, gx[8] = {}, gy[8] = {}, gz[8] = {};
  for (int l = 0; l < lanes; ++l) {
    int record[9];
    pencil_records<3>(window, s, l, record);
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

// Rate of deformation times dt in the strand's axes of mid-step: (11, 22, 33, 13, 23, 12), shears engineering.
STRANDLAB_INLINE void strain_increment(const Pack (&A)[4], const Pack (&middle)[4], Pack (&e)[6]) {
  Pack a[2];
  strand_axes(middle, a);
  const Pack cc = a[0] * a[0], ss = a[1] * a[1], cs = a[0] * a[1];
  const Pack shear = A[1] + A[2];
  e[0] = cc * A[0] + ss * A[3] + cs * shear;
  e[2] = ss * A[0] + cc * A[3] - cs * shear;
  e[3] = 2.0 * cs * (A[3] - A[0]) + (cc - ss) * shear;
  e[1] = e[4] = e[5] = Pack{};
}
STRANDLAB_INLINE void strain_increment(const Pack (&A)[9], const Pack (&middle)[9], Pack (&e)[6]) {
  Pack ax[3][3];
  strand_axes(middle, ax);
  Pack half[3][3];  // A e_k
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) half[k][i] = A[3 * i] * ax[k][0] + A[3 * i + 1] * ax[k][1] + A[3 * i + 2] * ax[k][2];
  }
  const auto component = [&](int j, int k) {
    return ax[j][0] * half[k][0] + ax[j][1] * half[k][1] + ax[j][2] * half[k][2];
  };
  e[0] = component(0, 0);
  e[1] = component(1, 1);
  e[2] = component(2, 2);
  e[3] = component(0, 2) + component(2, 0);
  e[4] = component(1, 2) + component(2, 1);
  e[5] = component(0, 1) + component(1, 0);
}

// Elastic trial stress and plastic correction; returns the dissipation per reference volume and adds dtau : d eps.
template <class Law, int N>
STRANDLAB_INLINE Pack update_stress(const wood::YieldModes<N>& modes, const Pack (&strain)[6], const Pack& J,
                                    double* block, int stress, int plastic, Pack& stress_change, long long& yielding,
                                    Mask& finite) {
  Pack tau[N];
  Pack size{};
  for (int i = 0; i < N; ++i) {
    tau[i] = load(block + (stress + i) * kBlock);
    for (int j = 0; j < N; ++j) tau[i] += modes.stiffness[i][j] * strain[j];
    size += absolute(tau[i]);
  }
  finite = (size < kLargestStress) & (J > 1e-6);
  Pack history = load(block + plastic * kBlock), radius = load(block + (plastic + 1) * kBlock);
  const Pack dissipation = wood::return_map<Law, PackOps, N>(modes, tau, J, history, radius);
  const Mask flowing = dissipation > 0.0;
  if (any(flowing)) {
    store(block + plastic * kBlock, history);
    store(block + (plastic + 1) * kBlock, radius);
    for (int l = 0; l < kBlock; ++l) yielding -= flowing[l];
  }
  stress_change = Pack{};
  for (int i = 0; i < N; ++i) {
    stress_change += (tau[i] - load(block + (stress + i) * kBlock)) * strain[i];
    store(block + (stress + i) * kBlock, tau[i]);
  }
  return dissipation;
}

// The same with the body's law and stress components.
template <int Dim>
STRANDLAB_INLINE Pack update_stress(const BodyView<Dim>& body, const Pack (&strain)[6], const Pack& J, double* block,
                                    Pack& stress_change, long long& yielding, Mask& finite) {
  using C = Component<Dim>;
  const auto update = [&]<class Law, int N>(const wood::YieldModes<N>& modes, Law) __attribute__((always_inline)) {
    return update_stress<Law, N>(modes, strain, J, block, C::stress, C::plastic(N), stress_change, yielding, finite);
  };
  if (body.components == 4) {
    return body.crushes ? update(*body.modes4, wood::CrushingLaw{}) : update(*body.modes4, wood::HillLaw{});
  }
  return body.crushes ? update(*body.modes6, wood::CrushingLaw{}) : update(*body.modes6, wood::HillLaw{});
}

template <int Dim>
void gather(const Tile& tile, const BodyView<Dim>& body, const Frame<Dim>& frame, const double* nodes,
            const unsigned char* lanes, bool profile, TileResult& result) {
  using C = Component<Dim>;
  Lap lap(profile);
  const long stride = static_cast<long>(C::count(body.components)) * kBlock;
  Pack plastic{}, kinetic{}, stress_change{}, drift[Dim] = {};
  for (int b = tile.block_begin; b < tile.block_end; ++b) {
    double* block = body.blocks + b * stride;
    prefetch(block, stride);
    Pack x[Dim], F[Dim * Dim], stretch[Dim];
    load_packs(block, x);
    load_packs(block + C::F * kBlock, F);
    diagonal<Dim>(F, stretch);
    Stencil<Dim> s;
    stencil_at<Dim>(x, stretch, body.half_size, frame, s);
    lap(result.ticks[0]);
    Motion<Dim> motion;
    gather_motion(s, body.window, nodes, lanes[b], motion);
    Mask real;
    for (int l = 0; l < kBlock; ++l) real[l] = l < lanes[b] ? -1 : 0;
    Pack change{}, moved[Dim];
    for (int a = 0; a < Dim; ++a) {
      const Pack dx = frame.dt * motion.v[a];
      store(block + a * kBlock, x[a] + dx);
      store(block + (C::v + a) * kBlock, load(block + (C::v + a) * kBlock) + motion.dv[a]);
      change += motion.dv[a] * motion.dv[a];
      moved[a] = absolute(dx);
    }
    kinetic += select(real, change, Pack{});
    lap(result.ticks[4]);
    Pack A[Dim * Dim], middle[Dim * Dim];
    for (int k = 0; k < Dim * Dim; ++k) A[k] = frame.dt * motion.L[k];
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
    const Pack dissipation = update_stress<Dim>(body, strain, J, block, change_here, result.yielding, ok);
    plastic += select(real, dissipation, Pack{});
    stress_change += select(real, change_here, Pack{});
    if (any(~ok) && result.bad == 0) result.bad = b + 1;
    lap(result.ticks[3]);
  }
  result.plastic += body.volume * sum(plastic);
  result.stress_change += 0.5 * body.volume * sum(stress_change);
  result.kinetic_change += 0.5 * body.mass * sum(kinetic);
  for (int a = 0; a < Dim; ++a) {
    const double d = largest(drift[a]) * frame.inverse_cell[a];
    result.drift[a] = d > result.drift[a] ? d : result.drift[a];
  }
}

template <int Dim>
void set_radius(const BodyView<Dim>& body, int blocks) {
  using C = Component<Dim>;
  const auto& crushing = body.components == 4 ? body.modes4->crushing : body.modes6->crushing;
  for (int b = 0; b < blocks; ++b) {
    double* plastic =
        body.blocks + (static_cast<long>(b) * C::count(body.components) + C::plastic(body.components)) * kBlock;
    Pack slope;
    store(plastic + kBlock, PackOps::crushing_radius(crushing, load(plastic), slope));
  }
}

}  // namespace

template <int Dim>
const Kernels<Dim>& build() {
  static constexpr Kernels<Dim> table{&scatter<Dim>, &update_grid<Dim>, &gather<Dim>, &set_radius<Dim>};
  return table;
}
template const Kernels<2>& build<2>();
template const Kernels<3>& build<3>();

}  // namespace strandlab::mpm::STRANDLAB_ISA
