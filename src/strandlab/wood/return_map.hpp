// Closest-point return to a quadratic yield surface that hardens, for one material point or a pack of them.
#pragma once

#include "strandlab/wood/hardening.hpp"

// Written for one point (ScalarOps) and for SIMD packs (the engine's PackOps) alike: Ops names the value type and the
// few operations on it. Plain arrays only, so that it can be compiled for several instruction sets.
namespace strandlab::wood {

// Yield surface f = q/J - radius, q^2 = tau^T P tau, in a basis z = to_modes tau in which both the elastic energy,
// |z|^2/2, and P = diag(lambda) are diagonal. N = 4: components (11, 22, 33, 13) of an aligned strand; N = 6: (11, 22,
// 33, 13, 23, 12).
template <int N>
struct YieldModes {
  double stiffness[N][N];      // MPa, tau = stiffness * strain
  double to_modes[N][N];       // MPa^-1/2
  double from_modes[N][N];     // MPa^1/2
  double lambda[N];            // 1/MPa
  double volume[N];            // MPa^-1/2, ln J_e = tr eps_e = volume . z
  double K_over_Y;             // -, Hill: radius = 1 + (K/Y) alpha^n
  double Y;                    // MPa, Y_R: d alpha = d lambda_plastic / Y_R
  double exponent;             // n
  CrushingHardening crushing;  // in place of Hill's where crushing.limit > 0
};

struct ScalarOps {
  using Value = double;
  static bool any(bool b) { return b; }
  static double select(bool c, double a, double b) { return c ? a : b; }
  static double square_root(double a) { return __builtin_sqrt(a); }
  static double absolute(double a) { return a < 0 ? -a : a; }
  static double exponential(double a) { return __builtin_exp(a); }
  static double power(double base, double exponent) { return __builtin_pow(base, exponent); }  // base > 0
  // d/d alpha of (K/Y) alpha^n; the default n = 4 without a call to pow.
  static double hardening_slope(double K_over_Y, double n, double alpha) {
    if (n == 4) return 4 * K_over_Y * (alpha * alpha * alpha);  // in the packs' order: restarts keep every bit
    return n * K_over_Y * __builtin_pow(alpha > 0 ? alpha : 0, n - 1);
  }
  static double crushing_radius(const CrushingHardening& h, double x, double& slope) {
    return wood::crushing_radius<ScalarOps>(h, x, slope);
  }
};

// Where a plastic multiplier mu = d lambda / q leads: q and ln J_e there, and their derivatives.
template <class T>
struct Flow {
  T mu, q, dq, volume, dvolume;
  T trial_volume;  // ln J_e at mu = 0
};

// The hardening that a flow brings: history variable, radius, and d radius / d mu.
template <class T>
struct Hardened {
  T history, radius, slope;
};

// Hill with a power law: radius = 1 + (K/Y) alpha^n, d alpha = d lambda / Y_R; alpha is the plastic strain of uniaxial
// radial loading.
struct HillLaw {
  static constexpr bool kNeedsVolume = false;

  template <class Ops, int N, class T>
  [[gnu::always_inline]] static Hardened<T> at(const YieldModes<N>& m, const Flow<T>& flow, const T& alpha0,
                                               const T& /*radius0*/, const T& /*J*/) {
    const T alpha = alpha0 + flow.mu * flow.q / m.Y;
    const T slope = Ops::hardening_slope(m.K_over_Y, m.exponent, alpha);  // d radius / d alpha
    return {alpha, 1.0 + slope * alpha / m.exponent, slope * (flow.q + flow.mu * flow.dq) / m.Y};
  }

  template <class Ops, int N, class T>
  [[gnu::always_inline]] static T kept_radius(const YieldModes<N>& /*m*/, const Hardened<T>& h) {
    return h.radius;
  }

  template <class Ops, int N, class T>
  [[gnu::always_inline]] static Hardened<T> first(const YieldModes<N>& m, const Flow<T>& flow, const T& alpha0,
                                                  const T& radius0, const T& J) {
    return at<Ops, N, T>(m, flow, alpha0, radius0, J);
  }
};

// Crushing: radius = H(x), x = 1 - min J_p. J_p needs no memory of its own: J_p = (1 - start) J/J_e, and ln J_e is
// linear in the stress.
struct CrushingLaw {
  static constexpr bool kNeedsVolume = true;

  template <class Ops, int N, class T>
  [[gnu::always_inline]] static Hardened<T> at(const YieldModes<N>& m, const Flow<T>& flow, const T& x0,
                                               const T& radius0, const T& J) {
    const T J_p = (1.0 - m.crushing.start) * J * Ops::exponential(-flow.trial_volume) *
                  small_exponential<Ops, T>(flow.trial_volume - flow.volume);
    const auto crushes = 1.0 - J_p > x0;
    Hardened<T> h;
    h.history = Ops::select(crushes, 1.0 - J_p, x0);
    if (!near<Ops, T>(m.crushing, h.history, x0, radius0, h))
      h.radius = Ops::crushing_radius(m.crushing, h.history, h.slope);
    h.slope = Ops::select(crushes, h.slope * J_p * flow.dvolume, T{});
    return h;
  }

  // exp(e) for what a step changes, by its series where it is small enough.
  template <class Ops, class T>
  [[gnu::always_inline]] static T small_exponential(const T& e) {
    if (Ops::any(Ops::absolute(e) > 0.01)) return Ops::exponential(e);
    return 1.0 + e * (1.0 + e * (1. / 2 + e * (1. / 6 + e * (1. / 24 + e * (1. / 120 + e * (1. / 720))))));
  }

  // What is kept: the radius that the history variable alone gives, so that a restart finds it again to the bit.
  template <class Ops, int N, class T>
  [[gnu::always_inline]] static T kept_radius(const YieldModes<N>& m, const Hardened<T>& h) {
    T slope;
    return Ops::crushing_radius(m.crushing, h.history, slope);
  }

  // H and its derivative a small step from x0, where H is known: with a = dx/x0 and b = dx/(x_L - x0) the power grows
  // by exp(m (ln(1 + a) - ln(1 - b))), here by their series, to 1e-13 of H. False where a step is larger than they
  // bear.
  template <class Ops, class T>
  [[gnu::always_inline]] static bool near(const CrushingHardening& c, const T& x, const T& x0, const T& radius0,
                                          Hardened<T>& h) {
    const T inverse_x = 1.0 / x0, inverse_room = 1.0 / (c.limit - x0);
    const T a = (x - x0) * inverse_x, b = (x - x0) * inverse_room;  // at x0 = 0 and beyond the limit neither is small
    const auto small = (a >= 0.0) & (a < 0.01) & (b >= 0.0) & (b < 0.01);
    if (Ops::any(Ops::select(small, T{}, T{} + 1.0) > 0.5)) return false;
    const T logarithm = a * (1.0 - a * (1. / 2 - a * (1. / 3 - a * (1. / 4 - a * (1. / 5))))) +
                        b * (1.0 + b * (1. / 2 + b * (1. / 3 + b * (1. / 4 + b * (1. / 5)))));
    const T e = c.exponent * logarithm;
    const T growth = 1.0 + e * (1.0 + e * (1. / 2 + e * (1. / 6 + e * (1. / 24 + e * (1. / 120 + e * (1. / 720))))));
    const T power = (radius0 - 1.0 - c.h1 * x0) * growth;
    h.radius = 1.0 + c.h1 * x + power;
    h.slope = c.h1 + power * (c.exponent * c.limit) * (inverse_x * (1.0 - a * (1.0 - a))) *
                         (inverse_room * (1.0 + b * (1.0 + b)));  // 1/x and 1/(x_L - x) to 1e-6: it only steers
    return true;
  }

  // Before any flow, from what is known: the slope need not be exact, Newton's method corrects it.
  template <class Ops, int N, class T>
  [[gnu::always_inline]] static Hardened<T> first(const YieldModes<N>& m, const Flow<T>& flow, const T& x0,
                                                  const T& radius0, const T& /*J*/) {
    const auto& c = m.crushing;
    const T some = Ops::select(x0 > 1e-30, x0, T{} + 1e-30);
    const T power = radius0 - 1.0 - c.h1 * x0;
    const T slope = c.h1 + power * (c.exponent * c.limit) / (some * (c.limit - x0));
    return {x0, radius0, Ops::select(flow.dvolume > 0.0, slope * (1.0 - x0) * flow.dvolume, T{})};
  }
};

// The flow mu from trial modes z: z_i(mu) = z_i/(1 + mu lambda_i). d = 1/(1 + mu lambda).
template <class Law, class Ops, int N, class T>
[[gnu::always_inline]] inline Flow<T> flow_at(const YieldModes<N>& m, const T (&z)[N], const T (&d)[N], const T& mu,
                                              const T& trial_volume) {
  T s2 = T{}, s3 = T{};
  Flow<T> flow{mu, T{}, T{}, T{}, T{}, trial_volume};
  for (int i = 0; i < N; ++i) {
    const T zi = z[i] * d[i];
    const T t = m.lambda[i] * zi * zi;
    s2 += t;
    s3 += t * m.lambda[i] * d[i];
    if constexpr (Law::kNeedsVolume) {
      flow.volume += m.volume[i] * zi;
      flow.dvolume -= m.volume[i] * m.lambda[i] * (zi * d[i]);
    }
  }
  flow.q = Ops::square_root(s2);
  flow.dq = -s3 / flow.q;
  return flow;
}

// Return mapping. On entry tau is the trial (Kirchhoff) stress, J the total volume ratio, `history` the law's history
// variable (Hill: alpha, crushing: x) and `radius` that of the surface there. Where the trial lies outside, tau,
// history and radius are updated to the closest point in the energy norm (associated flow, backward Euler); the return
// value is the dissipation tau : d eps_p per reference volume, mJ/mm^3.
//
// With mu = d lambda / q the returned modes are z_i = z_i^tr / (1 + mu lambda_i), and the one unknown mu solves
//   r(mu) = q(mu) - J radius(mu) = 0.
// r > 0 at mu = 0; q falls to 0 or, when crushing, the radius passes all bounds: Newton's method (on 1/q, which is
// nearly linear in mu) within a bracket that bisection keeps shrinking always converges. For Hill's law r is monotone.
template <class Law, class Ops, int N>
[[gnu::always_inline]] inline typename Ops::Value return_map(const YieldModes<N>& m, typename Ops::Value (&tau)[N],
                                                             const typename Ops::Value& J, typename Ops::Value& history,
                                                             typename Ops::Value& radius) {
  using T = typename Ops::Value;
  T z[N];
  T q2 = T{};
  for (int i = 0; i < N; ++i) {
    z[i] = m.to_modes[i][0] * tau[0];
    for (int j = 1; j < N; ++j) z[i] += m.to_modes[i][j] * tau[j];
    q2 += m.lambda[i] * z[i] * z[i];
  }
  const T limit = J * radius;
  const auto yields = q2 > limit * limit;
  if (!Ops::any(yields)) return T{};

  // Lanes that do not yield are carried along and discarded.
  constexpr int kMostIterations = 200, kNewtonAlone = 8;
  T d[N];
  for (int i = 0; i < N; ++i) d[i] = T{} + 1.0;
  T lo = T{}, hi = T{} + 1e300;
  Flow<T> flow = flow_at<Law, Ops, N, T>(m, z, d, T{}, T{});
  flow.trial_volume = flow.volume;
  Hardened<T> hard = Law::template first<Ops, N, T>(m, flow, history, radius, J);
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const T r = flow.q - J * hard.radius;
    const auto converged = Ops::absolute(r) <= 1e-12 * flow.q;
    if (!Ops::any(yields & !converged)) break;
    lo = Ops::select(r > 0.0, flow.mu, lo);
    hi = Ops::select(r > 0.0, hi, flow.mu);
    // Newton's method on 1/q - 1/(J radius) = 0.
    T next =
        flow.mu + r * flow.q * hard.radius / (hard.slope * flow.q * flow.q - flow.dq * J * hard.radius * hard.radius);
    const T middle = Ops::select(hi < 1e299, 0.5 * (lo + hi), 2.0 * flow.mu + 1e-6);
    next = Ops::select((next > lo) & (next < hi), next, middle);
    if (iteration > kNewtonAlone && iteration % 2 == 1) next = middle;
    const T mu = Ops::select(converged, flow.mu, next);
    for (int i = 0; i < N; ++i) d[i] = 1.0 / (1.0 + mu * m.lambda[i]);
    flow = flow_at<Law, Ops, N, T>(m, z, d, mu, flow.trial_volume);
    hard = Law::template at<Ops, N, T>(m, flow, history, radius, J);
  }
  for (int i = 0; i < N; ++i) z[i] = z[i] * d[i];
  for (int i = 0; i < N; ++i) {
    T t = m.from_modes[i][0] * z[0];
    for (int j = 1; j < N; ++j) t += m.from_modes[i][j] * z[j];
    tau[i] = Ops::select(yields, t, tau[i]);
  }
  history = Ops::select(yields, hard.history, history);
  radius = Ops::select(yields, Law::template kept_radius<Ops, N, T>(m, hard), radius);
  return Ops::select(yields, flow.mu * flow.q * flow.q, T{});
}

}  // namespace strandlab::wood
