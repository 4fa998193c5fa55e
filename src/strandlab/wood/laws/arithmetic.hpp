// What the return map and the laws of yielding share. Plain data and arithmetic only, so that it can be compiled for
// several instruction sets (see return_map.hpp).
#pragma once

namespace strandlab::wood {

// The operations of one point; the engine's PackOps has the same for packs of eight.
struct ScalarOps {
  using Value = double;
  static bool any(bool b) { return b; }
  static double select(bool c, double a, double b) { return c ? a : b; }
  static double square_root(double a) { return __builtin_sqrt(a); }
  static double absolute(double a) { return a < 0 ? -a : a; }
  static double exponential(double a) { return __builtin_exp(a); }
  static double power(double base, double exponent) { return __builtin_pow(base, exponent); }  // base > 0
  // The mathematical library's own power, base >= 0: on packs slower than power(), which is good to a few last places.
  static double library_power(double base, double exponent) { return __builtin_pow(base, exponent); }
};

// Where a plastic multiplier mu = d lambda / q leads: q and ln J_e there, and what their derivatives by mu are made of:
// q^2 = s2, d s2 = -2 s3, d s3 = -3 s4.
template <class T>
struct Flow {
  T mu, q, s2, s3, s4, volume, dvolume;
};

// The hardening that a flow brings: history variable, radius, and q d radius / d mu.
template <class T>
struct Hardened {
  T history, radius, slope;
};

}  // namespace strandlab::wood
