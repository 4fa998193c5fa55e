// Cure of resins at constant and at rising temperature.
#include "strandlab/transfer/cure.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "strandlab/transfer/properties.hpp"
#include "support/report.hpp"

namespace strandlab::transfer {
namespace {

struct Reference {
  Resin resin;
  std::array<double, 3> rate;          // 1/s at 100, 120, 150 C
  std::array<double, 2> after_minute;  // alpha after 60 s at 100, 120 C
  std::array<double, 3> t90;           // s at 100, 120, 150 C
  std::array<double, 3> ramp, ramp2;   // alpha at 100, 120, 140 C heated from 20 C at 1 and 2 K/s
};

class Cure : public testing::TestWithParam<Reference> {};

// Time to alpha = .9 at constant temperature: -ln .1/k, and (10^(n-1) - 1)/((n-1) k) for n other than 1.
TEST_P(Cure, ConstantTemperature) {
  const auto& p = GetParam();
  const std::array<double, 3> T{100, 120, 150};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(cure_rate(p.resin, T[i]), p.rate[i], 6e-6 * p.rate[i]);
    if (i < 2) {
      EXPECT_NEAR(cured(p.resin, 0, T[i], 60), p.after_minute[i], 6e-5);
    }
    EXPECT_NEAR(cured(p.resin, 0, T[i], p.t90[i]), .9, 2e-4);
    double alpha = 0;  // the same in any number of steps
    for (int n = 0; n < 7; ++n) alpha = cured(p.resin, alpha, T[i], 60. / 7);
    EXPECT_NEAR(alpha, cured(p.resin, 0, T[i], 60), 1e-12);
  }
}

// T = 20 + beta t: k t becomes (A/beta)(I(T) - I(20)), I = T_K exp(-E/(R T_K)) - (E/R) E1(E/(R T_K)).
double heated(const Resin& r, double beta, double T) {
  const auto integral = [&](double celsius) {
    const double kelvin = celsius + kZeroCelsius, x = r.activation_J_mol / (kGasConstant * kelvin);
    return kelvin * std::exp(-x) + kelvin * x * std::expint(-x);
  };
  const double kt = r.rate_1_s / beta * (integral(T) - integral(20));
  return r.order == 1 ? 1 - std::exp(-kt) : 1 - std::pow(1 + (r.order - 1) * kt, -1 / (r.order - 1));
}

TEST_P(Cure, RisingTemperature) {
  const auto& p = GetParam();
  for (const double beta : {1., 2.}) {
    double alpha = 0, T = 20;
    const double dt = .25;
    for (std::size_t i = 0; i < 3; ++i) {
      const double to = 100 + 20. * static_cast<double>(i);
      for (; T < to - 1e-9; T += beta * dt) alpha = cured(p.resin, alpha, T + beta * dt / 2, dt);
      const double given = beta == 1 ? p.ramp[i] : p.ramp2[i];
      EXPECT_NEAR(heated(p.resin, beta, to), given, 6e-6);
      EXPECT_NEAR(alpha, given, 6e-5);
    }
    if (beta == 2)
      report("cure of " + p.resin.name + " at 140 C, 2 K/s in steps of .25 s, less the exact one",
             alpha - heated(p.resin, 2, 140), "6e-5");
  }
}

INSTANTIATE_TEST_SUITE_P(Resins, Cure,
                         testing::Values(Reference{resins()[0],
                                                   {9.8577e-3, 3.97244e-2, 2.51014e-1},
                                                   {.4465, .9078},
                                                   {233.58, 57.96, 9.17},
                                                   {.11782, .42822, .88541},
                                                   {.06075, .24384, .66149}},
                                         Reference{resins()[1],
                                                   {4.38176e-2, 1.27207e-1, 5.20913e-1},
                                                   {.9279, .9995},
                                                   {52.55, 18.10, 4.42},
                                                   {.51006, .89900, .99864},
                                                   {.30004, .68219, .96319}},
                                         Reference{Resin{"third", 85e3, 7.8e9, 1.5, .5},
                                                   {9.8577e-3, 3.97244e-2, 2.51014e-1},
                                                   {.4044, .7918},
                                                   {438.70, 108.86, 17.23},
                                                   {.11449, .38917, .76957},
                                                   {.05985, .23020, .57922}}));

}  // namespace
}  // namespace strandlab::transfer
