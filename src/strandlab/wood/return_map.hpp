// Closest-point return to a quadratic yield surface that hardens, for one material point or a pack of them.
#pragma once

#include "strandlab/wood/laws/list.hpp"

// Written for one point (ScalarOps) and for SIMD packs (the engine's PackOps) alike: Ops names the value type and the
// few operations on it, L the law of laws/list.hpp that holds. Plain arrays only, so that it can be compiled for
// several instruction sets.
namespace strandlab::wood {

// Yield surface f = q/J - radius, q^2 = tau^T P tau, in a basis z = to_modes tau in which both the elastic energy,
// |z|^2/2, and P = diag(lambda) are diagonal. N = 4: components (11, 22, 33, 13) of an aligned strand; N = 6: (11, 22,
// 33, 13, 23, 12).
template <int N>
struct YieldModes {
  double stiffness[N][N];   // MPa, tau = stiffness * strain
  double to_modes[N][N];    // MPa^-1/2
  double from_modes[N][N];  // MPa^1/2
  double lambda[N];         // 1/MPa
  double volume[N];         // MPa^-1/2, ln J_e = tr eps_e = volume . z
  LawRules laws;            // how it hardens: that of the law that holds
};

// Wood at 20 C and 12 % whose yield knows no rate.
template <class T>
struct AsMeasured {
  static constexpr bool kConditioned = false;
};

// Wood that is softer or stiffer, by heat and moisture, and yields at a higher stress the faster it is crushed:
//   C0 -> e C0,   yield at f = g radius rate,   rate = (max(speed, floor)/reference)^n
// where speed = mu q/Y_R / (time that the step stands for) is that of the plastic strain.
template <class T>
struct Conditioned {
  static constexpr bool kConditioned = true;
  T e, g;             // factors of stiffness and of yield
  T strain;           // about the size of the step's strain: where the search for mu begins
  double exponent;    // n; 0: yield knows no rate
  double floor;       // over the reference
  double least;       // (floor/reference)^n
  double Y_R;         // MPa
  double per_strain;  // speed over the reference that a plastic strain of 1 in this step would have
};

// The flow mu from trial modes z: z_i(mu) = z_i/(1 + mu e lambda_i). d = 1/(1 + mu e lambda).
template <class L, class Ops, int N, class T, class Condition>
[[gnu::always_inline]] inline Flow<T> flow_at(const YieldModes<N>& m, const Condition& condition, const T (&z)[N],
                                              const T (&d)[N], const T& mu) {
  T s2 = T{}, s3 = T{}, s4 = T{}, volume = T{}, dvolume = T{};
  for (int i = 0; i < N; ++i) {
    const T zi = z[i] * d[i];
    T rate = m.lambda[i] * d[i];
    if constexpr (Condition::kConditioned) rate = rate * condition.e;
    const T t2 = m.lambda[i] * zi * zi, t3 = t2 * rate;
    s2 += t2;
    s3 += t3;
    s4 += t3 * rate;
    if constexpr (L::kNeedsVolume) {
      volume += m.volume[i] * zi;
      dvolume -= m.volume[i] * (zi * rate);
    }
  }
  if constexpr (L::kNeedsVolume && Condition::kConditioned) {
    volume = volume / condition.e;
    dvolume = dvolume / condition.e;
  }
  return {mu, Ops::square_root(s2), s2, s3, s4, volume, dvolume};
}

// What condition and rate make of the radius of the surface: its size, and q times its derivative by mu.
template <class T>
struct Strength {
  T radius, slope;
};
template <class Ops, class T, class Condition>
[[gnu::always_inline]] inline Strength<T> strength(const Condition& c, const Hardened<T>& hard, const Flow<T>& flow) {
  if constexpr (!Condition::kConditioned) {
    return {hard.radius, hard.slope};
  } else {
    const T radius = c.g * hard.radius, slope = c.g * hard.slope;
    if (c.exponent == 0) return {radius, slope};
    const T speed = flow.mu * flow.q * (c.per_strain / c.Y_R);
    const auto counts = speed > c.floor;
    const T rate = Ops::power(Ops::select(counts, speed, T{} + c.floor), c.exponent);
    // d ln(mu q)/d mu = 1/mu - s3/q^2
    const T mu = Ops::select(counts, flow.mu, T{} + 1.0);
    const T by_mu = Ops::select(counts, c.exponent * (flow.s2 - mu * flow.s3) / (mu * flow.q), T{});
    return {radius * rate, rate * (slope + radius * by_mu)};
  }
}

// Where the search begins if the rate counts: the flow at which 1/q, straight in mu from the trial on, meets a surface
// that does not harden, from 1/q0 + x s3/(q0^3 scale) = x^-n/limit in ln x, x = mu scale the speed over the reference.
template <class Ops, class T>
[[gnu::always_inline]] inline T first_flow(const Conditioned<T>& c, const Flow<T>& trial, const T& limit) {
  constexpr int kSteps = 4;
  const T scale = trial.q * (c.per_strain / c.Y_R);
  const T start = 1.0 / trial.q, slope = trial.s3 / (trial.q * trial.s2 * scale), inverse = 1.0 / limit;
  T x = (c.strain + 1e-14) * c.per_strain;
  for (int i = 0; i < kSteps; ++i) {
    const auto counts = x > c.floor;
    const T power = inverse * Ops::power(Ops::select(counts, x, T{} + c.floor), -c.exponent);
    const T straight = slope * x;
    const T part = (power - start - straight) / (straight + Ops::select(counts, c.exponent * power, T{}));
    x = Ops::select(part > 0.0, x * (1.0 + part), x / (1.0 - part));
  }
  return x / scale;
}

// Return mapping. On entry tau is the trial (Kirchhoff) stress, J the total volume ratio, `history` the law's history
// variable and `radius` that of the surface there, before condition and rate. Where the trial lies outside, tau,
// history and radius are updated to the closest point in the energy norm (associated flow, backward Euler); the return
// value is the dissipation tau : d eps_p per reference volume, mJ/mm^3.
//
// With mu = d lambda / q the returned modes are z_i = z_i^tr / (1 + mu lambda_i), and the one unknown mu solves
//   r(mu) = q(mu) - J radius(mu) = 0.
// r > 0 at mu = 0; q falls to 0 or, when crushing, the radius passes all bounds: a method of Newton's kind (on 1/q,
// which is nearly linear in mu) within a bracket that bisection keeps shrinking always converges. For Hill's law r is
// monotone. Where the rate counts the unknown is ln mu, in which its part of r is linear.
template <class L, class Ops, int N, class Condition = AsMeasured<typename Ops::Value>>
[[gnu::always_inline]] inline typename Ops::Value return_map(const YieldModes<N>& m, typename Ops::Value (&tau)[N],
                                                             const typename Ops::Value& J, typename Ops::Value& history,
                                                             typename Ops::Value& radius,
                                                             const Condition& condition = {}) {
  using T = typename Ops::Value;
  bool rated = false;
  if constexpr (Condition::kConditioned) rated = condition.exponent != 0;
  T z[N];
  T q2 = T{};
  for (int i = 0; i < N; ++i) {
    z[i] = m.to_modes[i][0] * tau[0];
    for (int j = 1; j < N; ++j) z[i] += m.to_modes[i][j] * tau[j];
    q2 += m.lambda[i] * z[i] * z[i];
  }
  T limit = J * radius;
  if constexpr (Condition::kConditioned) {
    limit = J * (condition.g * radius);
    if (rated) limit = limit * condition.least;
  }
  const auto yields = q2 > limit * limit;
  if (!Ops::any(yields)) return T{};

  // Lanes that do not yield are carried along and discarded.
  constexpr int kMostIterations = 200, kNewtonAlone = 8;
  constexpr double kRatedTolerance = 1e-9;  // a step of the search costs a power there
  T d[N];
  for (int i = 0; i < N; ++i) d[i] = T{} + 1.0;
  T lo = T{}, hi = T{} + 1e300;
  Flow<T> flow = flow_at<L, Ops, N, T>(m, condition, z, d, T{});
  const auto& rule = part_of<L>(m.laws);
  const typename L::template From<Ops> law(rule, history, radius, J, flow);
  Hardened<T> hard = law.before(flow);
  const auto go_to = [&](const T& mu) __attribute__((always_inline)) {
    for (int i = 0; i < N; ++i) {
      if constexpr (Condition::kConditioned) {
        d[i] = 1.0 / (1.0 + mu * (condition.e * m.lambda[i]));
      } else {
        d[i] = 1.0 / (1.0 + mu * m.lambda[i]);
      }
    }
    flow = flow_at<L, Ops, N, T>(m, condition, z, d, mu);
    hard = law.at(flow);
  };
  if constexpr (Condition::kConditioned) {
    if (rated) go_to(first_flow<Ops>(condition, flow, T(J * (condition.g * radius))));
  }
  Strength<T> now = strength<Ops>(condition, hard, flow);
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const T r = flow.q - J * now.radius;
    const auto converged = Ops::absolute(r) <= (rated ? kRatedTolerance : 1e-12) * flow.q;
    if (!Ops::any(yields & !converged)) break;
    lo = Ops::select(r > 0.0, flow.mu, lo);
    hi = Ops::select(r > 0.0, hi, flow.mu);
    // Newton's method on g = 1/q - 1/(J radius) = 0, its step made longer by what the curvature of 1/q asks for
    // (Halley's method with the hardening straight).
    const T square = J * now.radius * now.radius;
    const T inverse = 1.0 / (now.slope * flow.s2 + flow.s3 * square);  // 1/(q^3 J radius^2 dg/dmu)
    const T step = r * now.radius * inverse;                           // Newton's, over q^2
    T next;
    if (rated) {
      const T change = flow.s2 * step, part = change / flow.mu;
      next = Ops::select(part > 0.0, flow.mu + change, flow.mu / (1.0 - part));
    } else {
      const T longer = 1.5 * (flow.s2 * flow.s4 - flow.s3 * flow.s3) * square * inverse * step;
      next = flow.mu + flow.s2 * step * (1.0 + longer);
    }
    const T middle = Ops::select(hi < 1e299, 0.5 * (lo + hi), 2.0 * flow.mu + 1e-6);
    next = Ops::select((next > lo) & (next < hi), next, middle);
    if (iteration > kNewtonAlone && iteration % 2 == 1) next = middle;
    const T mu = Ops::select(converged, flow.mu, next);
    go_to(mu);
    now = strength<Ops>(condition, hard, flow);
  }
  for (int i = 0; i < N; ++i) z[i] = z[i] * d[i];
  for (int i = 0; i < N; ++i) {
    T t = m.from_modes[i][0] * z[0];
    for (int j = 1; j < N; ++j) t += m.from_modes[i][j] * z[j];
    tau[i] = Ops::select(yields, t, tau[i]);
  }
  history = Ops::select(yields, hard.history, history);
  radius = Ops::select(yields, L::template radius<Ops>(rule, hard.history), radius);
  return Ops::select(yields, flow.mu * flow.s2, T{});
}

}  // namespace strandlab::wood
