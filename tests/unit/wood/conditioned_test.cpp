// Wood that heat and moisture soften and whose yield knows a rate, at one point under confined strain.
#include <gtest/gtest.h>

#include <cmath>

#include "support/near.hpp"
#include "unit/wood/point.hpp"

namespace strandlab::wood {
namespace {

// Crushing without hardening or coupling of strains: confined, its stress through is g Y_R rate.
StrandMaterial ideal() {
  auto m = library()[0];
  m.law = Law::kCrushing;
  m.nu_RL = m.nu_TL = m.nu_TR = 0;
  m.crushing.c = m.crushing.h1 = m.crushing.h2 = 0;
  return in_strand_axes(m, 0);
}

struct Wood {
  double e, g, n;
};

class Conditions {
 public:
  Conditions(const StrandMaterial& material, Wood wood) : point_(material), wood_(wood) {}

  // A strain through the thickness that takes so many seconds; reference 1e-3/s, floor 1e-7/s.
  void advance(double strain, double seconds) {
    point_.ln_J += strain;
    double t[4];
    for (int i = 0; i < 4; ++i) t[i] = point_.tau[i] + wood_.e * point_.C(i, kThrough) * strain;
    const Conditioned<double> c{
        wood_.e, wood_.g, std::abs(strain), wood_.n, 1e-4, std::pow(1e-4, wood_.n), 3, 1 / (seconds * 1e-3)};
    with_law(point_.law, [&]<class L>() {
      return return_map<L, ScalarOps, 4>(point_.modes, t, point_.J(), point_.history, point_.radius, c);
    });
    for (int i = 0; i < 4; ++i) point_.tau[i] = t[i];
  }
  double stress() const { return -point_.cauchy(kThrough); }

 private:
  Point<4> point_;
  Wood wood_;
};

// sigma = g Y_R (rate/reference)^n under a steady rate, Y_R = 3 MPa. Under a steady stress tau = J sigma falls with J
// and takes elastic strain with it: the plastic rate is that of the strain times 1 + tau/(e E_R).
TEST(ConditionedWood, YieldsAtTheStressOfItsRate) {
  for (const double rate : {1e-5, 1e-3, 2e-2, 1.0}) {
    Conditions wood(ideal(), {.6, .7, .04});
    for (int i = 0; i < 3000; ++i) wood.advance(-1e-4, 1e-4 / rate);
    const double plastic = rate * (1 + std::exp(-.3) * wood.stress() / (.6 * library()[0].E_R));
    EXPECT_NEAR(wood.stress() / (.7 * 3 * std::pow(plastic / 1e-3, .04)), 1, 2e-6) << rate;
  }
}

// Below the floor the rate counts no more: 1e-7/s and 1e-9/s give the same.
TEST(ConditionedWood, KnowsNoRateBelowTheFloor) {
  Conditions wood(ideal(), {1, 1, .04});
  for (int i = 0; i < 2000; ++i) wood.advance(-1e-4, 1e5);
  EXPECT_NEAR(wood.stress(), 3 * std::pow(1e-4, .04), 1e-6);
}

// Held after yielding at a rate r the stress follows d sigma/dt = -E r0 (sigma/sigma_0)^(1/n): a straight line in log
// stress against log time, sigma = sigma_0 (1 + (1/n - 1) E r0 t/sigma_0)^(-n/(1-n)), E = e E_R.
TEST(ConditionedWood, RelaxesInAStraightLineOfLogStressAgainstLogTime) {
  constexpr double n = .04, rate = 1e-2;
  Conditions wood(ideal(), {.5, 1, n});
  for (int i = 0; i < 1000; ++i) wood.advance(-1e-4, 1e-2);
  const double s0 = wood.stress(), J = std::exp(-.1), E = .5 * library()[0].E_R / J;
  double t = 0;
  for (double dt = 1e-5; t < 1e3; dt *= 1.01) {
    wood.advance(0, dt);
    t += dt;
  }
  const double closed = s0 * std::pow(1 + (1 / n - 1) * E * rate * t / s0, -n / (1 - n));
  EXPECT_NEAR(wood.stress() / closed, 1, 1e-3);
  EXPECT_LT(wood.stress() / s0, .7);
}

// Factors of 1 without a rate are the wood as measured.
TEST(ConditionedWood, OfFactorOneIsTheWoodAsMeasured) {
  auto m = library()[0];
  m.law = Law::kCrushing;
  const auto material = in_strand_axes(m, 0);
  Conditions wood(material, {1, 1, 0});
  Point<4> plain(material);
  for (int i = 0; i < 2000; ++i) {
    wood.advance(-2e-4, 1);
    Components<4> increment = Components<4>::Zero();
    increment[kThrough] = -2e-4;
    plain.advance(increment);
    ASSERT_NEAR(wood.stress() / -plain.cauchy(kThrough), 1, 1e-12);
  }
}

}  // namespace
}  // namespace strandlab::wood
