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
  double stiffness[N][N];             // MPa, tau = stiffness * strain
  double to_modes[N][N];              // MPa^-1/2
  double from_modes[N][N];            // MPa^1/2
  double lambda[N];                   // 1/MPa
  double volume[N];                   // MPa^-1/2, ln J_e = tr eps_e = volume . z
  double K_over_Y;                    // -, Hill: radius = 1 + (K/Y) alpha^n
  double inverse_Y;                   // 1/MPa, 1/Y_R: d alpha = d lambda_plastic / Y_R
  double exponent, inverse_exponent;  // n, 1/n
  CrushingHardening crushing;         // in place of Hill's where crushing.limit > 0
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

// A law says, in From<Ops, N>, how the surface hardens in one step from the history variable and the radius before it.
// `trial` is the flow at mu = 0. What is kept of the radius is a function of the history variable alone, in the same
// bits wherever it is computed, so that a restart finds it again.

// Hill with a power law: radius = 1 + (K/Y) alpha^n, d alpha = d lambda / Y_R; alpha is the plastic strain of uniaxial
// radial loading.
struct HillLaw {
  static constexpr bool kNeedsVolume = false;

  template <class Ops, int N, class T = typename Ops::Value>
  class From {
   public:
    [[gnu::always_inline]] From(const YieldModes<N>& modes, const T& alpha0, const T& /*radius0*/, const T& /*J*/,
                                const Flow<T>& /*trial*/)
        : m_(modes), alpha0_(alpha0) {}
    [[gnu::always_inline]] Hardened<T> at(const Flow<T>& flow) const {
      const T alpha = alpha0_ + flow.mu * flow.q * m_.inverse_Y;
      const T slope = Ops::hardening_slope(m_.K_over_Y, m_.exponent, alpha);  // d radius / d alpha
      return {alpha, 1.0 + slope * alpha * m_.inverse_exponent, slope * (flow.s2 - flow.mu * flow.s3) * m_.inverse_Y};
    }
    [[gnu::always_inline]] Hardened<T> before(const Flow<T>& trial) const { return at(trial); }
    [[gnu::always_inline]] T kept_radius(const T& alpha) const {
      return 1.0 + Ops::hardening_slope(m_.K_over_Y, m_.exponent, alpha) * alpha / m_.exponent;
    }

   private:
    const YieldModes<N>& m_;
    T alpha0_;
  };
};

// Crushing: radius = H(x), x = 1 - min J_p. J_p needs no memory of its own: J_p = (1 - start) J/J_e, and ln J_e is
// linear in the stress.
struct CrushingLaw {
  static constexpr bool kNeedsVolume = true;

  template <class Ops, int N, class T = typename Ops::Value>
  class From {
   public:
    [[gnu::always_inline]] From(const YieldModes<N>& modes, const T& x0, const T& radius0, const T& J,
                                const Flow<T>& trial)
        : c_(modes.crushing), x0_(x0), radius0_(radius0), trial_volume_(trial.volume) {
      J_p0_ = (1.0 - c_.start) * J * Ops::exponential(-trial.volume);
      const T some = Ops::select(x0 > 1e-30, x0, T{} + 1e-30);
      room_ = c_.limit - x0;
      scale_ = 1.0 / (some * room_);
      // The power p = h2 (x/(x_L - x))^m obeys x (x_L - x) p' = m x_L p. So do its Taylor coefficients about x0.
      const double m = c_.exponent * c_.limit;
      power_[0] = radius0 - 1.0 - c_.h1 * x0;
      power_[1] = m * power_[0];
      for (int k = 1; k < kOrder; ++k) {
        power_[k + 1] = (1.0 / (k + 1)) * ((m - k * (room_ - x0)) * power_[k] + (k - 1) * (x0 * room_) * power_[k - 1]);
      }
    }

    [[gnu::always_inline]] Hardened<T> at(const Flow<T>& flow) const {
      const T J_p = J_p0_ * small_exponential(trial_volume_ - flow.volume);
      const auto crushes = 1.0 - J_p > x0_;
      Hardened<T> h;
      h.history = Ops::select(crushes, 1.0 - J_p, x0_);
      T by_x;  // d radius / dx
      if (!near(h.history, h.radius, by_x)) h.radius = Ops::crushing_radius(c_, h.history, by_x);
      h.slope = Ops::select(crushes, by_x * J_p * (flow.q * flow.dvolume), T{});
      return h;
    }

    // Before any flow, from what is known: the slope need not be exact, it only steers.
    [[gnu::always_inline]] Hardened<T> before(const Flow<T>& trial) const {
      const T slope = c_.h1 + power_[1] * scale_;
      return {x0_, radius0_, Ops::select(trial.dvolume > 0.0, slope * (1.0 - x0_) * (trial.q * trial.dvolume), T{})};
    }

    [[gnu::always_inline]] T kept_radius(const T& x) const {
      T slope;
      return Ops::crushing_radius(c_, x, slope);
    }

   private:
    // exp(e) for what a step changes, by its series where it is small enough.
    [[gnu::always_inline]] static T small_exponential(const T& e) {
      if (Ops::any(Ops::absolute(e) > 0.01)) return Ops::exponential(e);
      const T e2 = e * e;
      return (1.0 + e) + e2 * ((1. / 2 + e * (1. / 6)) + e2 * ((1. / 24 + e * (1. / 120)) + e2 * (1. / 720)));
    }

    // H and its derivative a small step from x0, by the series of the power: to 1e-13 of H. False where a step is
    // larger than they bear: dx/x0 or dx/(x_L - x0) of 1 % and more, and always at x0 = 0 and beyond the limit.
    [[gnu::always_inline]] bool near(const T& x, T& radius, T& by_x) const {
      const T u = (x - x0_) * scale_;
      if (Ops::any(!((u >= 0.0) & (u * room_ < 0.01) & (u * x0_ < 0.01)))) return false;
      const T u2 = u * u;
      const T power = (power_[0] + u * power_[1]) +
                      u2 * ((power_[2] + u * power_[3]) + u2 * ((power_[4] + u * power_[5]) + u2 * power_[6]));
      radius = 1.0 + c_.h1 * x + power;
      by_x = c_.h1 + scale_ * ((power_[1] + 2.0 * u * power_[2]) + u2 * (3.0 * power_[3]));  // it only steers
      return true;
    }

    static constexpr int kOrder = 6;
    const CrushingHardening& c_;
    T x0_, radius0_, trial_volume_, J_p0_;
    T room_, scale_;       // x_L - x0, 1/(x0 room)
    T power_[kOrder + 1];  // coefficients of ((x - x0) scale)^k
  };
};

// The flow mu from trial modes z: z_i(mu) = z_i/(1 + mu lambda_i). d = 1/(1 + mu lambda).
template <class Law, class Ops, int N, class T>
[[gnu::always_inline]] inline Flow<T> flow_at(const YieldModes<N>& m, const T (&z)[N], const T (&d)[N], const T& mu) {
  T s2 = T{}, s3 = T{}, s4 = T{}, volume = T{}, dvolume = T{};
  for (int i = 0; i < N; ++i) {
    const T zi = z[i] * d[i];
    const T rate = m.lambda[i] * d[i];
    const T t2 = m.lambda[i] * zi * zi, t3 = t2 * rate;
    s2 += t2;
    s3 += t3;
    s4 += t3 * rate;
    if constexpr (Law::kNeedsVolume) {
      volume += m.volume[i] * zi;
      dvolume -= m.volume[i] * (zi * rate);
    }
  }
  return {mu, Ops::square_root(s2), s2, s3, s4, volume, dvolume};
}

// Return mapping. On entry tau is the trial (Kirchhoff) stress, J the total volume ratio, `history` the law's history
// variable (Hill: alpha, crushing: x) and `radius` that of the surface there. Where the trial lies outside, tau,
// history and radius are updated to the closest point in the energy norm (associated flow, backward Euler); the return
// value is the dissipation tau : d eps_p per reference volume, mJ/mm^3.
//
// With mu = d lambda / q the returned modes are z_i = z_i^tr / (1 + mu lambda_i), and the one unknown mu solves
//   r(mu) = q(mu) - J radius(mu) = 0.
// r > 0 at mu = 0; q falls to 0 or, when crushing, the radius passes all bounds: a method of Newton's kind (on 1/q,
// which is nearly linear in mu) within a bracket that bisection keeps shrinking always converges. For Hill's law r is
// monotone.
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
  Flow<T> flow = flow_at<Law, Ops, N, T>(m, z, d, T{});
  const typename Law::template From<Ops, N> law(m, history, radius, J, flow);
  Hardened<T> hard = law.before(flow);
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const T r = flow.q - J * hard.radius;
    const auto converged = Ops::absolute(r) <= 1e-12 * flow.q;
    if (!Ops::any(yields & !converged)) break;
    lo = Ops::select(r > 0.0, flow.mu, lo);
    hi = Ops::select(r > 0.0, hi, flow.mu);
    // Newton's method on g = 1/q - 1/(J radius) = 0, its step made longer by what the curvature of 1/q asks for
    // (Halley's method with the hardening straight).
    const T square = J * hard.radius * hard.radius;
    const T inverse = 1.0 / (hard.slope * flow.s2 + flow.s3 * square);  // 1/(q^3 J radius^2 dg/dmu)
    const T step = r * hard.radius * inverse;                           // Newton's, over q^2
    const T longer = 1.5 * (flow.s2 * flow.s4 - flow.s3 * flow.s3) * square * inverse * step;
    T next = flow.mu + flow.s2 * step * (1.0 + longer);
    const T middle = Ops::select(hi < 1e299, 0.5 * (lo + hi), 2.0 * flow.mu + 1e-6);
    next = Ops::select((next > lo) & (next < hi), next, middle);
    if (iteration > kNewtonAlone && iteration % 2 == 1) next = middle;
    const T mu = Ops::select(converged, flow.mu, next);
    for (int i = 0; i < N; ++i) d[i] = 1.0 / (1.0 + mu * m.lambda[i]);
    flow = flow_at<Law, Ops, N, T>(m, z, d, mu);
    hard = law.at(flow);
  }
  for (int i = 0; i < N; ++i) z[i] = z[i] * d[i];
  for (int i = 0; i < N; ++i) {
    T t = m.from_modes[i][0] * z[0];
    for (int j = 1; j < N; ++j) t += m.from_modes[i][j] * z[j];
    tau[i] = Ops::select(yields, t, tau[i]);
  }
  history = Ops::select(yields, hard.history, history);
  radius = Ops::select(yields, law.kept_radius(hard.history), radius);
  return Ops::select(yields, flow.mu * flow.s2, T{});
}

}  // namespace strandlab::wood
