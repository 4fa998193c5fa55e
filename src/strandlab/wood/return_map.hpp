// Closest-point return to a quadratic yield surface with power-law hardening, for one material point or a pack of them.
#pragma once

// Written for one point (ScalarOps) and for SIMD packs (the engine's PackOps) alike: Ops names the value type and the
// few operations on it. Plain arrays only, so that it can be compiled for several instruction sets.
namespace strandlab::wood {

// Yield surface f = q/J - (1 + (K/Y_R) alpha^n), q^2 = tau^T P tau, in a basis z = to_modes tau in which both the
// elastic energy, |z|^2/2, and P = diag(lambda) are diagonal. N = 4: components (11, 22, 33, 13) of an aligned strand;
// N = 6: (11, 22, 33, 13, 23, 12).
template <int N>
struct YieldModes {
  double stiffness[N][N];   // MPa, tau = stiffness * strain
  double to_modes[N][N];    // MPa^-1/2
  double from_modes[N][N];  // MPa^1/2
  double lambda[N];         // 1/MPa
  double K_over_Y;          // -
  double Y;                 // MPa, Y_R: d alpha = d lambda_plastic / Y_R
  double exponent;          // n
};

// d/d alpha of (K/Y) alpha^n; the default n = 4 without a call to pow.
struct ScalarOps {
  using Value = double;
  static bool any(bool b) { return b; }
  static double select(bool c, double a, double b) { return c ? a : b; }
  static double square_root(double a) { return __builtin_sqrt(a); }
  static double absolute(double a) { return a < 0 ? -a : a; }
  static double hardening_slope(double K_over_Y, double n, double alpha) {
    if (n == 4) return 4 * K_over_Y * (alpha * alpha * alpha);  // in the packs' order: restarts keep every bit
    return n * K_over_Y * __builtin_pow(alpha > 0 ? alpha : 0, n - 1);
  }
};

// Return mapping. On entry tau is the trial (Kirchhoff) stress, J the total volume ratio, alpha the hardening variable
// and radius = 1 + (K/Y) alpha^n. Where the trial lies outside, tau, alpha and radius are updated to the closest point
// in the energy norm (associated flow, backward Euler); the return value is the dissipation tau : d eps_p per reference
// volume, mJ/mm^3.
//
// With mu = d lambda / q the returned modes are z_i = z_i^tr / (1 + mu lambda_i), and the one unknown mu solves
//   r(mu) = q(mu) - J (1 + (K/Y) (alpha_0 + mu q(mu)/Y)^n) = 0,
// where q falls and mu q rises with mu, so r is monotone: Newton with bisection as its safeguard always converges.
template <class Ops, int N>
[[gnu::always_inline]] inline typename Ops::Value return_map(const YieldModes<N>& m, typename Ops::Value (&tau)[N],
                                                             const typename Ops::Value& J, typename Ops::Value& alpha,
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

  const T alpha0 = alpha;
  // q(mu) and its derivative; lanes that do not yield are carried along and discarded.
  T lo = T{}, hi = T{} + 1e300, mu = T{}, q = Ops::square_root(q2), dq = T{};
  for (int i = 0; i < N; ++i) dq -= m.lambda[i] * m.lambda[i] * z[i] * z[i];
  dq = dq / q;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const T a = alpha0 + mu * q / m.Y;
    const T h_slope = Ops::hardening_slope(m.K_over_Y, m.exponent, a);  // d(hardening)/d alpha
    const T h = 1.0 + h_slope * a / m.exponent;                         // 1 + (K/Y) a^n
    const T r = q - J * h;
    const T dr = dq - J * h_slope * (q + mu * dq) / m.Y;
    const auto converged = Ops::absolute(r) <= 1e-12 * q;
    if (!Ops::any(yields & !converged)) break;
    lo = Ops::select(r > 0.0, mu, lo);
    hi = Ops::select(r > 0.0, hi, mu);
    T next = mu - r / dr;
    const T middle = Ops::select(hi < 1e299, 0.5 * (lo + hi), 2.0 * mu + 1e-6);
    next = Ops::select((next > lo) & (next < hi), next, middle);
    mu = Ops::select(converged, mu, next);
    T s2 = T{}, s3 = T{};
    for (int i = 0; i < N; ++i) {
      const T d = 1.0 / (1.0 + mu * m.lambda[i]);
      const T t = m.lambda[i] * (z[i] * d) * (z[i] * d);
      s2 += t;
      s3 += t * m.lambda[i] * d;
    }
    q = Ops::square_root(s2);
    dq = -s3 / q;
  }
  for (int i = 0; i < N; ++i) z[i] = z[i] / (1.0 + mu * m.lambda[i]);
  for (int i = 0; i < N; ++i) {
    T t = m.from_modes[i][0] * z[0];
    for (int j = 1; j < N; ++j) t += m.from_modes[i][j] * z[j];
    tau[i] = Ops::select(yields, t, tau[i]);
  }
  alpha = Ops::select(yields, alpha0 + mu * q / m.Y, alpha0);
  radius = Ops::select(yields, 1.0 + Ops::hardening_slope(m.K_over_Y, m.exponent, alpha) * alpha / m.exponent, radius);
  return Ops::select(yields, mu * q * q, T{});
}

}  // namespace strandlab::wood
