// A pack of eight doubles, one lane per particle. GCC vector extension: compiles to whatever the target has.
// Included, as all of this folder, only by kernels.cpp, which is compiled once per instruction set; everything lives in
// that build's own namespace.
#pragma once

#include "strandlab/wood/return_map.hpp"

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
template <int N>
STRANDLAB_INLINE void load_packs(const double* from, Pack (&to)[N]) {
  for (int i = 0; i < N; ++i) to[i] = load(from + i * kLanes);
}
// Asks for the next block while this one is worked on; a block is too long for the hardware to see the stream.
STRANDLAB_INLINE void prefetch(const double* block, long stride) {
  for (long i = 0; i < stride; i += kLanes) __builtin_prefetch(block + stride + i);
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
// One number under the names of a pack's operations, for functions that work on both.
STRANDLAB_INLINE double select(bool c, double a, double b) {
  return c ? a : b;
}
STRANDLAB_INLINE double larger(double a, double b) {
  return a > b ? a : b;
}
STRANDLAB_INLINE double square_root(double a) {
  return __builtin_sqrt(a);
}
STRANDLAB_INLINE double sum(const Pack& a) {
  return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}
STRANDLAB_INLINE double largest(const Pack& a) {
  double r = a[0];
  for (int l = 1; l < kLanes; ++l) r = a[l] > r ? a[l] : r;
  return r;
}
STRANDLAB_INLINE Pack library_power(const Pack& base, double exponent) {
  Pack r;
  for (int l = 0; l < kLanes; ++l) r[l] = __builtin_pow(base[l], exponent);
  return r;
}

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

STRANDLAB_INLINE Pack as_pack(const Mask& m) {
  Pack a;
  __builtin_memcpy(&a, &m, sizeof a);
  return a;
}
STRANDLAB_INLINE Mask as_bits(const Pack& a) {
  Mask m;
  __builtin_memcpy(&m, &a, sizeof m);
  return m;
}

inline constexpr double kLn2High = 6.93147180369123816490e-01, kLn2Low = 1.90821492927058770002e-10;

// e^a to a few units in the last place, |a| up to 700: 2^k e^r with |r| <= ln 2 / 2, e^r by its series to r^13.
STRANDLAB_INLINE Pack exponential(const Pack& argument) {
  const Pack a = smaller(larger(argument, splat(-700.0)), splat(700.0));
  const Pack k = shifted(a * 1.44269504088896340736);
  const Pack n = k - kRounder;
  const Pack r = (a - n * kLn2High) - n * kLn2Low;
  const Pack r2 = r * r, r4 = r2 * r2;
  const Pack low = (1.0 + r) + r2 * (1.0 / 2 + r * (1.0 / 6));
  const Pack middle = (1.0 / 24 + r * (1.0 / 120)) + r2 * (1.0 / 720 + r * (1.0 / 5040));
  const Pack high = (1.0 / 40320 + r * (1.0 / 362880)) + r2 * (1.0 / 3628800 + r * (1.0 / 39916800));
  const Pack highest = 1.0 / 479001600 + r * (1.0 / 6227020800);
  const Pack series = low + r4 * (middle + r4 * (high + r4 * highest));
  return series * as_pack((bits(k) + 1023) << 52);
}

// ln a of normal positive numbers, by fdlibm's e_log.c (Sun Microsystems, 1993).
STRANDLAB_INLINE Pack logarithm(const Pack& a) {
  const Mask ia = as_bits(a);
  const Mask exponent = (ia - 0x3fe6a09e667f3bcdL) >> 52;  // mantissa from sqrt(1/2) to sqrt(2)
  const Pack f = as_pack(ia - (exponent << 52)) - 1.0;
  const Pack k = as_pack(exponent + 0x4338000000000000L) - kRounder;
  const Pack s = f / (2.0 + f);
  const Pack z = s * s, w = z * z;
  const Pack even = w * (3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
  const Pack odd = z * (6.666666666666735130e-01 +
                        w * (2.857142874366239149e-01 + w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
  const Pack half = 0.5 * f * f;
  return k * kLn2High - ((half - (s * (half + (even + odd)) + k * kLn2Low)) - f);
}

// What wood::return_map needs to work on packs.
struct PackOps {
  using Value = Pack;
  STRANDLAB_INLINE static bool any(const Mask& m) { return STRANDLAB_ISA::any(m); }
  STRANDLAB_INLINE static Pack select(const Mask& c, const Pack& a, const Pack& b) { return c ? a : b; }
  STRANDLAB_INLINE static Pack square_root(const Pack& a) { return STRANDLAB_ISA::square_root(a); }
  STRANDLAB_INLINE static Pack absolute(const Pack& a) { return STRANDLAB_ISA::absolute(a); }
  STRANDLAB_INLINE static Pack exponential(const Pack& a) { return STRANDLAB_ISA::exponential(a); }
  STRANDLAB_INLINE static Pack power(const Pack& base, double exponent) {
    return STRANDLAB_ISA::exponential(exponent * STRANDLAB_ISA::logarithm(base));
  }
  STRANDLAB_INLINE static Pack library_power(const Pack& base, double exponent) {
    return STRANDLAB_ISA::library_power(base, exponent);
  }
};

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
