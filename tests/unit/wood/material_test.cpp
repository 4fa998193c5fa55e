#include "strandlab/wood/material.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "strandlab/core/eigenvalues.hpp"
#include "strandlab/core/error.hpp"

namespace strandlab::wood {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

Material poplar() {
  return library()[0];
}

// Young's modulus along the strand in a plane-strain section: no strain across (22, 23, 12), free through the
// thickness.
double plane_strain_modulus(const Material& material, double angle_deg) {
  const VoigtMatrix C = in_strand_axes(material, angle_deg).stiffness;
  Eigen::Matrix3d section;
  const int axes[3] = {0, 2, 4};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) section(i, j) = C(axes[i], axes[j]);
  }
  return 1 / section.inverse()(0, 0);
}

// Le (2010) Tables 3.1 and 3.2.
TEST(Library, HoldsTheTwoMaterialsOfTheSource) {
  ASSERT_EQ(library().size(), 2U);
  const auto& p = library()[0];
  const auto& v = library()[1];
  EXPECT_EQ(p.name, "poplar");
  EXPECT_EQ(p.density_kg_m3, 350);
  EXPECT_EQ(p.E_L, 9936);
  EXPECT_EQ(p.hill.S_RT, 2.5);
  EXPECT_EQ(v.name, "vtc");
  EXPECT_EQ(v.density_kg_m3, 910);
  EXPECT_EQ(v.E_L, 24311);
  EXPECT_EQ(v.E_R, 2153);
  EXPECT_EQ(v.E_T, 1005);
  EXPECT_EQ(v.G_RL, 1616);
  EXPECT_EQ(v.G_TL, 1486);
  EXPECT_EQ(v.G_RT, 235);
  EXPECT_EQ(v.hill.S_RT, 10);
  for (const auto& m : library()) EXPECT_NO_THROW(validate(m)) << m.name;
}

// nu_ij/E_i = nu_ji/E_j gives the other three ratios: .304, .396, .706 (read off the compliance: nu_ij = -S_ji/S_ii).
TEST(Compliance, OtherPoissonRatiosFollowByReciprocity) {
  const VoigtMatrix S = compliance(poplar());
  const int L = 0, T = 1, R = 2;
  EXPECT_NEAR(-S(R, L) / S(L, L), 0.304, 0.0005);
  EXPECT_NEAR(-S(T, L) / S(L, L), 0.396, 0.0005);
  EXPECT_NEAR(-S(T, R) / S(R, R), 0.706, 0.0005);
  EXPECT_DOUBLE_EQ(-S(L, R) / S(R, R), 0.028);
  EXPECT_DOUBLE_EQ(-S(L, T) / S(T, T), 0.017);
  EXPECT_DOUBLE_EQ(-S(R, T) / S(T, T), 0.33);
}

TEST(Stiffness, UndoesTheCompliance) {
  for (const auto& m : library()) {
    const VoigtMatrix one = stiffness(m) * compliance(m);
    EXPECT_LT((one - VoigtMatrix::Identity()).cwiseAbs().maxCoeff(), 1e-13) << m.name;
    EXPECT_EQ(stiffness(m)(3, 3), m.G_RT);
    EXPECT_EQ(stiffness(m)(4, 4), m.G_RL);
    EXPECT_EQ(stiffness(m)(5, 5), m.G_TL);
  }
}

// Plane-strain moduli of a row at 0, 45 and 90 degrees and their average over all angles, from an independent
// calculation (physics reference, closed-form models).
TEST(StrandAxes, PlaneStrainModuli) {
  EXPECT_NEAR(plane_strain_modulus(poplar(), 0), 10003.3, 0.05);
  EXPECT_NEAR(plane_strain_modulus(poplar(), 45), 3379.3, 0.05);
  EXPECT_NEAR(plane_strain_modulus(poplar(), 90), 429.9, 0.05);
  double sum = 0;
  constexpr int kAngles = 3600;  // the trapezium rule on a period converges faster than any power
  for (int i = 0; i < kAngles; ++i) sum += plane_strain_modulus(poplar(), -90 + 180.0 * i / kAngles);
  EXPECT_NEAR(sum / kAngles, 4297.9, 0.05);
}

// At 90 degrees the along and across axes change places: 11 <-> 22, 23 <-> 13; the matrices are permutations, exactly.
TEST(StrandAxes, CoreStrandIsAPermutation) {
  const int swap[6] = {1, 0, 2, 4, 3, 5};
  const auto along = in_strand_axes(poplar(), 0);
  for (const double angle : {90.0, -90.0, 270.0}) {
    const auto core = in_strand_axes(poplar(), angle);
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        EXPECT_EQ(core.stiffness(i, j), along.stiffness(swap[i], swap[j]));
        EXPECT_EQ(core.yield_surface(i, j), along.yield_surface(swap[i], swap[j]));
      }
    }
  }
  EXPECT_EQ(in_strand_axes(poplar(), 180).stiffness, along.stiffness);
  EXPECT_EQ(along.stiffness, stiffness(poplar()));
}

// The elastic energy and the yield function of a given stress state do not depend on the axes it is written in. Checked
// with full 3 x 3 tensors turned by the angle, which shares nothing with the 6 x 6 rotation.
TEST(StrandAxes, EnergyAndYieldFunctionAreInvariant) {
  Material m = poplar();
  m.hill.Y_L = 40;  // every entry of the Hill matrix takes part
  m.hill.Y_T = 4.8;
  m.hill.S_RL = 6;
  m.hill.S_TL = 7;
  validate(m);
  Tensor<3> strain;
  strain << 0.01, 0.004, -0.003, 0.004, -0.02, 0.006, -0.003, 0.006, 0.015;
  Tensor<3> stress;
  stress << 3, 0.4, -0.3, 0.4, -2, 0.6, -0.3, 0.6, 1.5;
  const auto voigt = [](const Tensor<3>& a, double shear) {
    Voigt v;
    v << a(0, 0), a(1, 1), a(2, 2), shear * a(1, 2), shear * a(0, 2), shear * a(0, 1);
    return v;
  };
  const auto wood = in_strand_axes(m, 0);
  for (const double angle : {-90.0, -33.0, 17.0, 45.0, 90.0, 120.0}) {
    const double t = angle * std::numbers::pi / 180;
    Tensor<3> axes;  // columns: wood axes in strand axes
    axes << std::cos(t), -std::sin(t), 0, std::sin(t), std::cos(t), 0, 0, 0, 1;
    const Voigt strain_wood = voigt(axes.transpose() * strain * axes, 2);
    const Voigt stress_wood = voigt(axes.transpose() * stress * axes, 1);
    const auto strand = in_strand_axes(m, angle);
    const Voigt e = voigt(strain, 2), s = voigt(stress, 1);
    EXPECT_NEAR(e.dot(strand.stiffness * e), strain_wood.dot(wood.stiffness * strain_wood), 1e-12) << angle;
    EXPECT_NEAR(s.dot(strand.yield_surface * s), stress_wood.dot(wood.yield_surface * stress_wood), 1e-12) << angle;
    EXPECT_EQ(strand.stiffness, strand.stiffness.transpose());
    EXPECT_EQ(strand.yield_surface, strand.yield_surface.transpose());
  }
}

// f = 1 under each yield stress alone; the cross terms are those of Hill's function: pressure does not yield, and equal
// R and T compression with Y_R = Y_T, Y_L infinite never does.
TEST(Hill, YieldStressesLieOnTheSurface) {
  Material m = poplar();
  m.hill.Y_L = 40;
  m.hill.Y_T = 4.8;
  m.hill.S_RL = 6;
  m.hill.S_TL = 7;
  const VoigtMatrix P = in_strand_axes(m, 0).yield_surface;
  const double yields[6] = {m.hill.Y_L, m.hill.Y_T, m.hill.Y_R, m.hill.S_RT, m.hill.S_RL, m.hill.S_TL};
  for (int i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(P(i, i) * yields[i] * yields[i], 1) << i;
  Voigt pressure;
  pressure << 1, 1, 1, 0, 0, 0;
  EXPECT_LT((P * pressure).cwiseAbs().maxCoeff(), 1e-17);
}

TEST(Hill, InfiniteYieldLeavesZeros) {
  const VoigtMatrix P = in_strand_axes(poplar(), 0).yield_surface;
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(P(0, i), 0);  // along the grain
    EXPECT_EQ(P(4, i), 0);  // LR and LT shear
    EXPECT_EQ(P(5, i), 0);
  }
  EXPECT_EQ(P(1, 2), -P(1, 1));  // only |sigma_R - sigma_T| yields
  EXPECT_TRUE(P.allFinite());
}

TEST(StrandAxes, CarriesDensityAndHardening) {
  const auto s = in_strand_axes(library()[1], 30);
  EXPECT_DOUBLE_EQ(s.density, 910e-12);
  EXPECT_EQ(s.hardening.hill.Y_R, 5);
  EXPECT_EQ(s.hardening.hill.K, 120);
  EXPECT_EQ(s.hardening.hill.n, 4);
}

// The same invariance for the law that crushes; its surface sees pressure.
TEST(Crushing, YieldFunctionIsInvariantAndSeesPressure) {
  Material m = poplar();
  m.law = Law::kCrushing;
  m.crushing.Y_T = 2.5;
  validate(m);
  const auto wood = in_strand_axes(m, 0);
  const auto& k = m.crushing;
  const double yields[6] = {k.Y_L, k.Y_T, k.Y_R, k.S_RT, k.S_RL, k.S_TL};
  for (int i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(wood.yield_surface(i, i) * yields[i] * yields[i], 1) << i;
  EXPECT_DOUBLE_EQ(wood.yield_surface(1, 2), -k.c / (k.Y_R * k.Y_T));
  Tensor<3> stress;
  stress << 3, 0.4, -0.3, 0.4, -2, 0.6, -0.3, 0.6, 1.5;
  const auto voigt = [](const Tensor<3>& a) {
    Voigt v;
    v << a(0, 0), a(1, 1), a(2, 2), a(1, 2), a(0, 2), a(0, 1);
    return v;
  };
  for (const double angle : {-90.0, -33.0, 17.0, 45.0, 120.0}) {
    const double t = angle * std::numbers::pi / 180;
    Tensor<3> axes;  // columns: wood axes in strand axes
    axes << std::cos(t), -std::sin(t), 0, std::sin(t), std::cos(t), 0, 0, 0, 1;
    const Voigt here = voigt(stress), there = voigt(axes.transpose() * stress * axes);
    const auto strand = in_strand_axes(m, angle);
    EXPECT_NEAR(here.dot(strand.yield_surface * here), there.dot(wood.yield_surface * there), 1e-12) << angle;
    EXPECT_EQ(strand.hardening.crushing.limit, wood.hardening.crushing.limit);
  }
  Voigt pressure;
  pressure << 1, 1, 1, 0, 0, 0;
  EXPECT_GT(pressure.dot(wood.yield_surface * pressure), 0.1);
}

// Rows free to shear across: the section's stresses see the rotated compliance and surface with tau_12 = tau_23 = 0,
// found here by asking the full stiffness which shears make those stresses vanish. The free bar's modulus, nothing
// held, is that of a bar cut off the grain (Jones, Mechanics of Composite Materials, Eq. 2.97).
TEST(Uncoupled, LeavesNoStressInTheShearsAcross) {
  const Material m = poplar();
  for (const double angle : {-60.0, 20.0, 45.0}) {
    const auto exact = in_strand_axes(m, angle), freed = in_strand_axes(m, angle, OffAxis::kUncoupled);
    Voigt strain;
    strain << 0.01, -0.003, -0.02, 0, 0.006, 0;
    Eigen::Matrix2d shears;
    shears << exact.stiffness(3, 3), exact.stiffness(3, 5), exact.stiffness(5, 3), exact.stiffness(5, 5);
    const Voigt held = exact.stiffness * strain;
    const Eigen::Vector2d gamma = -shears.inverse() * Eigen::Vector2d(held[3], held[5]);
    Voigt let = strain;
    let[3] = gamma[0];
    let[5] = gamma[1];
    const Voigt expected = exact.stiffness * let, stress = freed.stiffness * strain;
    EXPECT_NEAR(expected[3], 0, 1e-12);
    EXPECT_NEAR(expected[5], 0, 1e-12);
    for (const int i : {0, 1, 2, 4}) EXPECT_NEAR(stress[i], expected[i], 1e-10) << angle << ", component " << i;
    Voigt section = stress;
    section[3] = section[5] = 0;
    EXPECT_NEAR(section.dot(freed.yield_surface * section), section.dot(exact.yield_surface * section), 1e-9) << angle;
    const double t = angle * std::numbers::pi / 180, c2 = std::cos(t) * std::cos(t), s2 = 1 - c2;
    const double nu_LT = m.nu_TL * m.E_L / m.E_T;
    const double bar = 1 / (c2 * c2 / m.E_L + (1 / m.G_TL - 2 * nu_LT / m.E_L) * s2 * c2 + s2 * s2 / m.E_T);
    const VoigtMatrix compliance_freed = freed.stiffness.inverse();
    EXPECT_NEAR(1 / compliance_freed(0, 0), bar, 1e-9 * bar) << angle;
  }
  for (const double angle : {0.0, 90.0}) {  // aligned rows know no difference
    EXPECT_EQ(in_strand_axes(m, angle).stiffness, in_strand_axes(m, angle, OffAxis::kUncoupled).stiffness);
  }
}

TEST(Names, OfLawsAndOffAxisChoices) {
  for (const Law law : {Law::kHill, Law::kCrushing}) EXPECT_EQ(law_from_name(name(law)), law);
  for (const OffAxis choice : {OffAxis::kExact, OffAxis::kUncoupled}) {
    EXPECT_EQ(off_axis_from_name(name(choice)), choice);
  }
  EXPECT_THROW(law_from_name("hills"), InputError);
  EXPECT_THROW(off_axis_from_name("none"), InputError);
}

struct BadMaterial {
  const char* name;
  std::function<void(Material&)> spoil;
  std::vector<const char*> told;
};

class ValidateRejects : public testing::TestWithParam<BadMaterial> {};

TEST_P(ValidateRejects, NamingTheConstantAndTheRule) {
  Material m = poplar();
  GetParam().spoil(m);
  try {
    validate(m);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find("material \"poplar\": "), 0U) << message;
    for (const auto* words : GetParam().told) EXPECT_NE(message.find(words), std::string::npos) << message;
  }
}

// Bounds: |nu_RL| < sqrt(914/9936) = 0.30330, |nu_TL| < sqrt(427/9936) = 0.20730, |nu_TR| < sqrt(427/914) = 0.68350.
INSTANTIATE_TEST_SUITE_P(
    Constants, ValidateRejects,
    testing::Values(
        BadMaterial{"ZeroModulus", [](Material& m) { m.E_R = 0; }, {"E_R = 0", "positive"}},
        BadMaterial{"NegativeModulus", [](Material& m) { m.G_RT = -109; }, {"G_RT = -109", "positive"}},
        BadMaterial{"InfiniteModulus", [](Material& m) { m.E_L = kUnbounded; }, {"E_L = inf", "finite"}},
        BadMaterial{"NanModulus", [](Material& m) { m.E_T = std::nan(""); }, {"E_T = nan"}},
        BadMaterial{"NoDensity", [](Material& m) { m.density_kg_m3 = 0; }, {"density_kg_m3 = 0"}},
        BadMaterial{
            "PoissonRL", [](Material& m) { m.nu_RL = 0.304; }, {"not positive definite: nu_RL = 0.304", "0.303"}},
        BadMaterial{
            "PoissonTL", [](Material& m) { m.nu_TL = -0.21; }, {"not positive definite: nu_TL = -0.21", "-0.2073"}},
        BadMaterial{"PoissonTR", [](Material& m) { m.nu_TR = 0.7; }, {"not positive definite: nu_TR = 0.7", "0.6835"}},
        BadMaterial{"PoissonNan", [](Material& m) { m.nu_TR = std::nan(""); }, {"nu_TR = nan"}},
        // Each pair is admissible alone, the three together are not; the tightest, nu_TR at .95 of its bound, is named.
        BadMaterial{"PoissonTogether",
                    [](Material& m) {
                      m.nu_RL = 0.8 * 0.3033;
                      m.nu_TL = 0.8 * 0.2073;
                      m.nu_TR = 0.95 * 0.6835;
                    },
                    {"not positive definite", "other Poisson ratios as given", "nu_TR = 0.649"}},
        BadMaterial{"ZeroYield", [](Material& m) { m.hill.S_RT = 0; }, {"S_RT = 0", "positive"}},
        BadMaterial{"NegativeYield", [](Material& m) { m.hill.Y_L = -8; }, {"Y_L = -8", "positive"}},
        BadMaterial{
            "InfiniteRadialYield", [](Material& m) { m.hill.Y_R = m.hill.Y_T = kUnbounded; }, {"Y_R must be finite"}},
        BadMaterial{"HillWithInfiniteL",
                    [](Material& m) { m.hill.Y_T = 5.1; },
                    {"not positive semi-definite", "Y_R = 5", "Y_T = 5.1", "|1/Y_R - 1/Y_T| <= 1/Y_L"}},
        BadMaterial{"HillWithFiniteL",
                    [](Material& m) {
                      m.hill.Y_L = 40;
                      m.hill.Y_T = 4;
                    },
                    {"not positive semi-definite", "|1/Y_R - 1/Y_T| <= 1/Y_L"}},  // .05 > .025
        BadMaterial{"HillWeakGrain",
                    [](Material& m) { m.hill.Y_L = 2; },
                    {"not positive semi-definite", "Y_L = 2", "1/Y_L <= 1/Y_R + 1/Y_T"}},
        BadMaterial{"NegativeHardening", [](Material& m) { m.hill.K = -1; }, {"hardening_K = -1"}},
        BadMaterial{"CrushingYield",
                    [](Material& m) {
                      m.law = Law::kCrushing;
                      m.crushing.S_RT = 0;
                    },
                    {"crushing_S_RT = 0", "positive"}},
        BadMaterial{"CrushingPoisson",
                    [](Material& m) {
                      m.law = Law::kCrushing;
                      m.crushing.c = 1.01;
                    },
                    {"not positive semi-definite", "crushing_c = 1.01", "-1 and 1"}},
        BadMaterial{"CrushingHardening",
                    [](Material& m) {
                      m.law = Law::kCrushing;
                      m.crushing.h2 = -0.5;
                    },
                    {"crushing_h2 = -0.5"}},
        BadMaterial{"CrushingExponent",
                    [](Material& m) {
                      m.law = Law::kCrushing;
                      m.crushing.exponent = 0.9;
                    },
                    {"crushing_m = 0.9", "at least 1"}},
        BadMaterial{"CrushingStart",
                    [](Material& m) {
                      m.law = Law::kCrushing;
                      m.crushing.start = 1;
                    },
                    {"crushing_start = 1", "less than 1"}},
        BadMaterial{"CrushingCellWall",
                    [](Material& m) {
                      m.law = Law::kCrushing;
                      m.density_kg_m3 = 1500;
                    },
                    {"density_kg_m3 = 1500", "nothing to crush", "1500"}},
        BadMaterial{"HardeningExponent", [](Material& m) { m.hill.n = 0.5; }, {"hardening_n = 0.5", "at least 1"}}),
    [](const auto& tested) { return tested.param.name; });

// The limits themselves: just inside is accepted, and there the smallest eigenvalues are what the rules say.
TEST(Validate, RulesAreSharp) {
  Material m = poplar();
  m.nu_RL = 0.5 * std::sqrt(m.E_R / m.E_L);
  m.nu_TL = 0.5 * std::sqrt(m.E_T / m.E_L);
  const double limit = 0.5 * std::sqrt(m.E_T / m.E_R);  // 1 - 3/4 - 2/8 = 0 at c = 1/2
  m.nu_TR = limit * (1 - 1e-9);
  EXPECT_NO_THROW(validate(m));
  EXPECT_GT(eigenvalues(compliance(m))[0], 0);
  m.nu_TR = limit * (1 + 1e-9);
  EXPECT_THROW(validate(m), InputError);

  Material hill = poplar();
  hill.hill.Y_L = 40;
  hill.hill.Y_T = 1 / (1 / hill.hill.Y_R + 1 / hill.hill.Y_L);  // exactly on |1/Y_R - 1/Y_T| = 1/Y_L
  EXPECT_NO_THROW(validate(hill));
  const VoigtMatrix P = in_strand_axes(hill, 0).yield_surface;
  EXPECT_GT(eigenvalues(P)[0], -1e-15);
}

}  // namespace
}  // namespace strandlab::wood
