// Crushing: cells collapse and the wood densifies (docs/crushing.md).
//   f^2 = (s_L/Y_L)^2 + (s_R/Y_R)^2 + (s_T/Y_T)^2 - 2 c s_R s_T/(Y_R Y_T) + sum (tau_ij/S_ij)^2,  yield at f = H(x),
//   H = 1 + h1 x + h2 (x/(x_L - x))^m,  x_L = 1 - rho0/1500
// x = 1 - min J_p over the history, J_p = (1 - start) exp(tr eps_p), is the collapsed part of the volume, which never
// falls. H has no bound as x nears x_L, where all pores are gone. Wood that comes densified has collapsed by `start`
// already; its uncrushed density is rho0 = density (1 - start). What a law is made of: laws/list.hpp.
#pragma once

#include "strandlab/wood/laws/arithmetic.hpp"

namespace strandlab::wood {

struct LawDescription;
struct Material;

// Constants as measured for poplar of 350 kg/m^3.
struct Crushing {
  double Y_L = 40, Y_R = 3, Y_T = 3;          // MPa
  double S_RT = 1.5, S_RL = 6, S_TL = 6;      // MPa
  double c = 0.1;                             // -, plastic Poisson ratio: 0 no lateral flow, 1 no change of volume
  double h1 = 0.5, h2 = 0.5, exponent = 1.3;  // -
  double start = 0;                           // -, x as formed

  static const LawDescription& description();

  struct Hardening {
    double limit = 0;                     // x_L; 0: this law does not hold
    double x0 = 0;                        // x of the strand as formed
    double h1 = 0, h2 = 0, exponent = 1;  // -
    double start() const { return x0; }
    bool holds() const { return limit > 0; }
    template <class Self, class Visit>
    static void visit(Self& self, const Visit& visit_number) {
      visit_number("crushing_limit", "1", "x_L: yield at f = 1 + h1 x + h2 (x/(x_L - x))^m; 0: by K and n", self.limit);
      visit_number("crushing_start", "1", "x as formed", self.x0);
      visit_number("crushing_h1", "1", "h1", self.h1);
      visit_number("crushing_h2", "1", "h2", self.h2);
      visit_number("crushing_m", "1", "m", self.exponent);
    }
  };
  static Hardening hardening(const Material& material);

  using Rule = Hardening;
  static Rule rule(const Hardening& h) { return h; }

  static constexpr bool kNeedsVolume = true;

  // Volume that is locked in as wood stiffens has collapsed.
  static double locked_in(const Rule& h, double x, double J, double ln_J_e) {
    const double collapsed = 1 - (1 - h.x0) * J * __builtin_exp(-ln_J_e);
    return collapsed > x ? collapsed : x;
  }

  // H(x), and its derivative in `by_x`. Beyond the limit H is huge and its slope 0. One function for all its uses: what
  // a restart computes from the history variable is what the run had, to the bit.
  template <class Ops, class T = typename Ops::Value>
  [[gnu::noinline]] static T radius(const Rule& h, const T& x, T& by_x) {
    const T zero = T{};
    const T room = h.limit - x;
    const auto inside = room > 1e-12;
    const T gap = Ops::select(inside, room, zero + 1e-12);
    const T some = Ops::select(x > 1e-30, x, zero + 1e-30);  // the power and its slope have limits at x = 0
    const T inverse = 1.0 / (some * gap);
    const T power = h.h2 * Ops::power(some * some * inverse, h.exponent);
    by_x = Ops::select(inside, h.h1 + power * (h.exponent * h.limit) * inverse, zero);
    return 1.0 + h.h1 * x + power;
  }
  template <class Ops, class T = typename Ops::Value>
  [[gnu::always_inline]] static T radius(const Rule& h, const T& x) {
    T by_x;
    return radius<Ops>(h, x, by_x);
  }

  // J_p needs no memory of its own: J_p = (1 - start) J/J_e, and ln J_e is linear in the stress.
  template <class Ops, class T = typename Ops::Value>
  class From {
   public:
    [[gnu::always_inline]] From(const Rule& rule, const T& x0, const T& radius0, const T& J, const Flow<T>& trial)
        : c_(rule), x0_(x0), radius0_(radius0), trial_volume_(trial.volume) {
      J_p0_ = (1.0 - c_.x0) * J * Ops::exponential(-trial.volume);
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
      if (!near(h.history, h.radius, by_x)) h.radius = Crushing::radius<Ops>(c_, h.history, by_x);
      h.slope = Ops::select(crushes, by_x * J_p * (flow.q * flow.dvolume), T{});
      return h;
    }

    // Before any flow, from what is known: the slope need not be exact, it only steers.
    [[gnu::always_inline]] Hardened<T> before(const Flow<T>& trial) const {
      const T slope = c_.h1 + power_[1] * scale_;
      return {x0_, radius0_, Ops::select(trial.dvolume > 0.0, slope * (1.0 - x0_) * (trial.q * trial.dvolume), T{})};
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
    const Rule& c_;
    T x0_, radius0_, trial_volume_, J_p0_;
    T room_, scale_;       // x_L - x0, 1/(x0 room)
    T power_[kOrder + 1];  // coefficients of ((x - x0) scale)^k
  };
};

}  // namespace strandlab::wood
