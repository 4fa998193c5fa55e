// Elastic constants from E_L by a species' ratios.
#include "strandlab/wood/species.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "strandlab/core/error.hpp"

namespace strandlab::wood {
namespace {

// The hybrid poplar of Le (2010), Table 3.1 is E_L = 9936 MPa with the ratios of yellow-poplar, printed to whole MPa.
TEST(Species, YellowPoplarGivesTheTabulatedPoplar) {
  const auto& poplar = library().front();
  const auto m = with_ratios(poplar, find_species("yellow-poplar"));
  EXPECT_NEAR(m.E_R, poplar.E_R, .5);
  EXPECT_NEAR(m.E_T, poplar.E_T, .5);
  EXPECT_NEAR(m.G_RL, poplar.G_RL, .5);
  EXPECT_NEAR(m.G_TL, poplar.G_TL, .5);
  EXPECT_NEAR(m.G_RT, poplar.G_RT, .5);
  EXPECT_NEAR(m.nu_TR, poplar.nu_TR, .005);
  EXPECT_NEAR(m.nu_RL, .030, .001);  // the handbook's own nu_RL and nu_TL
  EXPECT_NEAR(m.nu_TL, .019, .003);
}

// E_L, density and yield stay; moduli scale with E_L, Poisson's ratios do not; reciprocity holds by construction.
TEST(Species, RatiosScaleWithTheAxialModulus) {
  Material own = library().front();
  own.E_L = 12000;
  own.density_kg_m3 = 500;
  for (const auto& s : species()) {
    const auto m = with_ratios(own, s);
    EXPECT_EQ(m.E_L, 12000);
    EXPECT_EQ(m.density_kg_m3, 500);
    EXPECT_EQ(m.hill.Y_R, own.hill.Y_R);
    EXPECT_DOUBLE_EQ(m.E_R, 12000 * s.E_R) << s.name;
    EXPECT_NEAR(m.nu_RL / m.E_R, s.nu_LR / m.E_L, 1e-18) << s.name;
    EXPECT_NEAR(m.nu_TL / m.E_T, s.nu_LT / m.E_L, 1e-18) << s.name;
    EXPECT_NEAR(m.nu_TR / m.E_T, s.nu_RT / m.E_R, 1e-18) << s.name;
    EXPECT_NO_THROW(validate(m)) << s.name;
  }
}

TEST(Species, TellsWhichConstantsAreDerived) {
  auto m = with_ratios(library().front(), find_species("douglas-fir"));
  EXPECT_EQ(constants_from_ratios(m, find_species("douglas-fir")).size(), 8U);
  m.E_R = 1000;  // measured after all
  const auto names = constants_from_ratios(m, find_species("douglas-fir"));
  EXPECT_EQ(names.size(), 7U);
  EXPECT_EQ(std::count(names.begin(), names.end(), "E_R"), 0);
}

TEST(Species, UnknownOnesAreAnsweredByTheNearest) {
  try {
    find_species("yelow-poplar");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean \"yellow-poplar\"?"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("\"sitka-spruce\""), std::string::npos) << error.what();
  }
}

// Softened wood has every yield stress and K scaled, in any strand axes: f(factor s) is f(s) before, and K/Y_R and the
// elastic stiffness are as they were.
TEST(Softened, ScalesYieldExactlyAndKeepsElasticity) {
  std::vector<Material> materials = library();
  materials.push_back(library()[0]);
  materials.back().law = Law::kCrushing;
  for (const auto& material : materials) {
    const auto soft = softened(material, .5);
    for (const double angle : {0.0, 30.0, 90.0}) {
      const auto a = in_strand_axes(material, angle), b = in_strand_axes(soft, angle);
      EXPECT_EQ(b.stiffness, a.stiffness);
      EXPECT_LT((b.yield_surface - 4 * a.yield_surface).norm(), 1e-15 * a.yield_surface.norm()) << angle;
      EXPECT_EQ(b.hardening.hill.Y_R, .5 * a.hardening.hill.Y_R);
      EXPECT_EQ(b.hardening.hill.K, .5 * a.hardening.hill.K);
      EXPECT_EQ(b.hardening.hill.n, a.hardening.hill.n);
    }
  }
}

}  // namespace
}  // namespace strandlab::wood
