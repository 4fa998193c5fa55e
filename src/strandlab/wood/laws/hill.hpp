// Hill's law with hardening by a power of the plastic strain: yield without change of volume. Le (2010), Eq. 3.1
// to 3.3, with the misprints of 3.2 and 3.3 put right as Hill (1950) has them.
//   f^2 = Hill's quadratic form of the stress (hill.cpp),  yield at f = 1 + (K/Y_R) alpha^n,  d alpha = d lambda / Y_R
// alpha is the plastic strain of uniaxial radial loading. What a law is made of: laws/list.hpp.
#pragma once

#include <limits>

#include "strandlab/wood/laws/arithmetic.hpp"

namespace strandlab::wood {

struct LawDescription;
struct Material;

struct Hill {
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  double Y_L = kNever;      // MPa, yield stress along the grain
  double Y_R = 5, Y_T = 5;  // MPa
  double S_RT = 2.5;        // MPa, yield stress in shear
  double S_RL = kNever;     // MPa
  double S_TL = kNever;     // MPa
  double K = 120;           // MPa
  double n = 4;             // -

  static const LawDescription& description();

  struct Hardening {
    double Y_R = 0;  // MPa, makes alpha dimensionless
    double K = 0;    // MPa
    double n = 0;    // -
    double start() const { return 0; }
    bool holds() const { return true; }
    template <class Self, class Visit>
    static void visit(Self& self, const Visit& visit_number) {
      visit_number("yield_stress_MPa", "MPa", "Y_R", self.Y_R);
      visit_number("hardening_K_MPa", "MPa", "K: yield at f = 1 + (K/Y_R) alpha^n", self.K);
      visit_number("hardening_n", "1", "n", self.n);
    }
  };
  static Hardening hardening(const Material& material);

  struct Rule {
    double K_over_Y;                    // -
    double inverse_Y;                   // 1/MPa, 1/Y_R
    double exponent, inverse_exponent;  // n, 1/n
  };
  static Rule rule(const Hardening& h) { return {h.K / h.Y_R, 1 / h.Y_R, h.n, 1 / h.n}; }

  static constexpr bool kNeedsVolume = false;

  // Strain that is locked in as wood stiffens does not harden it.
  static double locked_in(const Rule& /*rule*/, double alpha, double /*J*/, double /*ln_J_e*/) { return alpha; }

  template <class Ops, class T = typename Ops::Value>
  [[gnu::always_inline]] static T radius(const Rule& rule, const T& alpha) {
    return 1.0 + slope<Ops>(rule, alpha) * alpha / rule.exponent;
  }

  template <class Ops, class T = typename Ops::Value>
  class From {
   public:
    [[gnu::always_inline]] From(const Rule& rule, const T& alpha0, const T& /*radius0*/, const T& /*J*/,
                                const Flow<T>& /*trial*/)
        : rule_(rule), alpha0_(alpha0) {}
    [[gnu::always_inline]] Hardened<T> at(const Flow<T>& flow) const {
      const T alpha = alpha0_ + flow.mu * flow.q * rule_.inverse_Y;
      const T by_alpha = slope<Ops>(rule_, alpha);
      return {alpha, 1.0 + by_alpha * alpha * rule_.inverse_exponent,
              by_alpha * (flow.s2 - flow.mu * flow.s3) * rule_.inverse_Y};
    }
    [[gnu::always_inline]] Hardened<T> before(const Flow<T>& trial) const { return at(trial); }

   private:
    const Rule& rule_;
    T alpha0_;
  };

 private:
  // d/d alpha of (K/Y) alpha^n; the default n = 4 without a call to pow.
  template <class Ops, class T = typename Ops::Value>
  [[gnu::always_inline]] static T slope(const Rule& rule, const T& alpha) {
    if (rule.exponent == 4) return 4 * rule.K_over_Y * (alpha * alpha * alpha);
    return rule.exponent * rule.K_over_Y * Ops::library_power(Ops::select(alpha > 0.0, alpha, T{}), rule.exponent - 1);
  }
};

}  // namespace strandlab::wood
