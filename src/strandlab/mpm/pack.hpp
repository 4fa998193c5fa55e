// A pack of eight doubles, one lane per particle. GCC vector extension: compiles to whatever the target has.
// Included only by kernels.cpp, which is compiled once per instruction set; everything lives in that build's own
// namespace.
#pragma once

namespace strandlab::mpm::STRANDLAB_ISA {

inline constexpr int kLanes = 8;
using Pack = double __attribute__((vector_size(64)));
using Mask = decltype(Pack{} < Pack{});  // 64-bit integer lanes, all bits set where true
using Quad = double __attribute__((vector_size(32)));

#define STRANDLAB_INLINE __attribute__((always_inline)) inline

STRANDLAB_INLINE Pack load(const double* p) {
  Pack r;
  __builtin_memcpy(&r, p, sizeof r);
  return r;
}
STRANDLAB_INLINE void store(double* p, const Pack& a) {
  __builtin_memcpy(p, &a, sizeof a);
}
STRANDLAB_INLINE Pack splat(double a) {
  return a - Pack{};
}
STRANDLAB_INLINE Pack select(const Mask& c, const Pack& a, const Pack& b) {
  return c ? a : b;
}
STRANDLAB_INLINE Pack select(const Mask& c, double a, const Pack& b) {
  return c ? splat(a) : b;
}
STRANDLAB_INLINE Pack smaller(const Pack& a, const Pack& b) {
  return a < b ? a : b;
}
STRANDLAB_INLINE Pack larger(const Pack& a, const Pack& b) {
  return a > b ? a : b;
}
STRANDLAB_INLINE Pack absolute(const Pack& a) {
  return larger(a, -a);
}
STRANDLAB_INLINE bool any(const Mask& m) {
  long long r = 0;
  for (int l = 0; l < kLanes; ++l) r |= m[l];
  return r != 0;
}
STRANDLAB_INLINE Pack square_root(const Pack& a) {
  Pack r;
  for (int l = 0; l < kLanes; ++l) r[l] = __builtin_sqrt(a[l]);
  return r;
}
STRANDLAB_INLINE double sum(const Pack& a) {
  return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}
STRANDLAB_INLINE double largest(const Pack& a) {
  double r = a[0];
  for (int l = 1; l < kLanes; ++l) r = a[l] > r ? a[l] : r;
  return r;
}
STRANDLAB_INLINE Pack hardening_slope(double K_over_Y, double n, const Pack& alpha) {
  if (n == 4) return 4 * K_over_Y * (alpha * alpha * alpha);
  Pack r;
  for (int l = 0; l < kLanes; ++l) r[l] = n * K_over_Y * __builtin_pow(alpha[l] > 0 ? alpha[l] : 0.0, n - 1);
  return r;
}

// What wood::return_map needs to work on packs.
struct PackOps {
  using Value = Pack;
  STRANDLAB_INLINE static bool any(const Mask& m) { return STRANDLAB_ISA::any(m); }
  STRANDLAB_INLINE static Pack select(const Mask& c, const Pack& a, const Pack& b) { return c ? a : b; }
  STRANDLAB_INLINE static Pack square_root(const Pack& a) { return STRANDLAB_ISA::square_root(a); }
  STRANDLAB_INLINE static Pack absolute(const Pack& a) { return STRANDLAB_ISA::absolute(a); }
  STRANDLAB_INLINE static Pack hardening_slope(double K_over_Y, double n, const Pack& alpha) {
    return STRANDLAB_ISA::hardening_slope(K_over_Y, n, alpha);
  }
};

// Nearest integer of each lane, as double, by the 1.5*2^52 trick (|a| < 2^31); bits() then holds it in the low half.
inline constexpr double kRounder = 6755399441055744.0;
STRANDLAB_INLINE Pack shifted(const Pack& a) {
  return a + kRounder;
}
STRANDLAB_INLINE Mask bits(const Pack& s) {
  Mask m;
  __builtin_memcpy(&m, &s, sizeof m);
  return m - 0x4338000000000000L;
}

// Transposes eight packs: on return row[l] holds lane l of all eight.
STRANDLAB_INLINE void transpose(Pack (&r)[8]) {
  Pack t[8], u[8];
  for (int i = 0; i < 8; i += 2) {
    t[i] = __builtin_shufflevector(r[i], r[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    t[i + 1] = __builtin_shufflevector(r[i], r[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int i = 0; i < 8; i += 4) {
    for (int k = 0; k < 2; ++k) {
      u[i + k] = __builtin_shufflevector(t[i + k], t[i + k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      u[i + k + 2] = __builtin_shufflevector(t[i + k], t[i + k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
  for (int k = 0; k < 4; ++k) {
    r[k] = __builtin_shufflevector(u[k], u[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    r[k + 4] = __builtin_shufflevector(u[k], u[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

}  // namespace strandlab::mpm::STRANDLAB_ISA
