// Softening factors, and the column against its own law solved by hand.
#include "strandlab/hotpress/column.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/hotpress/softening.hpp"

namespace strandlab::hotpress {
namespace {

// A, g, e at (C, kg/kg), from the exact formulas by an independent program.
TEST(Softening, Factors) {
  const Softening s;
  const std::array<std::array<double, 5>, 12> rows{{{20, .05, 1, 1.3607, 1.2423},
                                                    {20, .08, 1, 1.1924, 1.1320},
                                                    {50, .06, .7935, 1.0332, .9557},
                                                    {50, .12, .6484, .6484, .6484},
                                                    {50, .20, .6191, .4354, .4831},
                                                    {100, .05, .5877, .7997, .7301},
                                                    {100, .08, .5260, .6272, .5954},
                                                    {100, .12, .4089, .4089, .4089},
                                                    {110, .14, .3718, .3405, .3495},
                                                    {120, .08, .4703, .5608, .5324},
                                                    {180, .01, .4295, .6969, .6041},
                                                    {200, 0, .4053, .6872, .5880}}};
  for (const auto& [T, M, A, g, e] : rows) {
    EXPECT_NEAR(heat_factor(s, T, M), A, 6e-5) << T << " " << M;
    EXPECT_NEAR(yield_factor(s, T, M), g, 6e-5) << T << " " << M;
    EXPECT_NEAR(stiffness_factor(s, T, M), e, 6e-5) << T << " " << M;
  }
  EXPECT_DOUBLE_EQ(yield_factor(s, 20, .3), yield_factor(s, 20, .25));  // no water between the fibres' walls above that
}

const wood::Material& poplar() {
  return wood::library().front();
}
constexpr double kE = 914e6, kY = 3e6, kLimit = 1 - 350. / 1500;

double hardening(double x) {
  return 1 + .5 * x + .5 * std::pow(x / (kLimit - x), 1.3);
}

TEST(Column, ElasticUnderASmallStress) {
  Column column({layer_of(poplar(), .01)}, {0});
  column.load(1e6, 1);
  const double J = column.height() / .01;
  EXPECT_NEAR(std::log(J), -J * 1e6 / kE, 1e-15);
  EXPECT_DOUBLE_EQ(column.height_unloaded(), .01);
  column.load(-1e5, 1);
  EXPECT_GT(column.height(), .01);
}

// Without rate effect the stress is Y_R H(x) where it yields.
TEST(Column, CrushesByTheHardeningLaw) {
  Column column({layer_of(poplar(), .01)}, {0});
  column.press_to(.006, 10);
  const double x = 1 - column.height_unloaded() / .01;
  EXPECT_NEAR(column.stress(), kY * hardening(x), 1e-6 * kY);
  EXPECT_NEAR(column.height(), .006, 1e-14);
}

// 8.8 % a decade of rate: 10^.04.
TEST(Column, YieldsAtMoreStressWhenFaster) {
  const auto stress = [](double seconds) {
    Column column({layer_of(poplar(), .01)}, {.04});
    column.condition({1e6}, {1});  // so stiff that the strain is plastic
    column.press_to(.006, seconds);
    return column.stress();
  };
  EXPECT_NEAR(stress(1) / stress(10), std::pow(10, .04), 1e-6);
  EXPECT_NEAR(stress(1), kY * hardening(.4) * std::pow(-std::log(.6) / 1e-3, .04), 20);
}

// At a strain that is held elastic strain becomes plastic, rate = -(d sigma/dt)/E, so that sigma ~ rate^n falls as
// t^(-n/(1 - n)): 9.1 % a decade for n = .04.
TEST(Column, RelaxesByAPowerOfTime) {
  Column column({layer_of(poplar(), .01)}, {.04});
  column.press_to(.007, 10);
  const auto hold = [&](double from, double to) {
    const int steps = 400;
    for (int i = 0; i < steps; ++i) {
      const double t0 = from * std::pow(to / from, double(i) / steps),
                   t1 = from * std::pow(to / from, double(i + 1) / steps);
      column.press_to(.007, t1 - t0);
    }
    return column.stress();
  };
  hold(.01, 10);
  const double after_10 = column.stress(), after_100 = hold(10, 100);
  EXPECT_NEAR(after_100 / after_10, std::pow(10, -.04 / .96), 2e-4);
}

// Heating under a height that is held: elastic strain stays, so that stress falls by exactly the stiffness.
TEST(Column, SofteningRelaxesStressByTheStiffness) {
  Column column({layer_of(poplar(), .01)}, {0});
  column.press_to(.00999, 1);
  const double before = column.stress();
  column.soften({.5}, {1});
  column.press_to(.00999, 1);
  EXPECT_NEAR(column.stress() / before, .5, 1e-9);
}

// Set: what was strained hot stays when it is cold again, but for what the stiffer wood gives back.
TEST(Column, CoolingLocksStrainIn) {
  Column column({layer_of(poplar(), .01)}, {0});
  column.condition({.5}, {10});
  column.press_to(.0099, 1);
  const double elastic = std::log(.99);
  column.soften({1}, {10});
  column.load(0, 1);
  EXPECT_NEAR(std::log(column.height() / .01), .5 * elastic, 1e-12);
}

// Layers in series bear the same stress: the soft one is crushed first.
TEST(Column, SoftLayerIsCrushedFirst) {
  Column column({layer_of(poplar(), .005), layer_of(poplar(), .005)}, {0});
  column.condition({1, 1}, {1, .5});
  column.press_to(.0075, 10);
  const auto t = column.thickness();
  EXPECT_LT(t[1], t[0]);
  const double x = 1 - t[1] / .005 * std::exp(column.stress() * t[1] / .005 / kE);
  EXPECT_NEAR(column.stress(), .5 * kY * hardening(x), 1e-6 * kY);
}

// Wood that comes densified has been crushed already.
TEST(Column, DensifiedWoodStartsFurtherUpTheCurve) {
  Column normal({layer_of(poplar(), .01)}, {0}), dense({layer_of(wood::library()[1], .01)}, {0});
  normal.press_to(.0095, 1);
  dense.press_to(.0095, 1);
  EXPECT_GT(dense.stress(), 2 * normal.stress());
}

TEST(Column, RefusesLayersWithoutThicknessAndImpossibleHeights) {
  EXPECT_THROW(Column({layer_of(poplar(), 0)}, {}), InputError);
  Column column({layer_of(poplar(), .01)}, {});
  EXPECT_THROW(column.press_to(1e-6, 1), RunError);
}

}  // namespace
}  // namespace strandlab::hotpress
