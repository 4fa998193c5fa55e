#include "strandlab/bondline/shear_lag.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "strandlab/core/error.hpp"

namespace strandlab::bondline {
namespace {

// Equal strands, t = .69 mm, E = 9936 MPa, G = E/15, l = 25 mm, W = 6 mm.
Geometry equal_strands() {
  return {};
}

Geometry unequal_strands() {
  return {8200, 12500, 610.0, {}, 0.55, 0.83, 5.9, 18, 4, 7};
}

// Plane finite elements of the same specimen agree with the closed form to .2 %; the closed form is wanted to 4 digits.
TEST(ShearLag, ComplianceRatioOfEqualStrands) {
  constexpr std::array<double, 5> kCompliance{0, .0021, .01628, .06536, .14645};
  constexpr std::array<double, 5> kRatio{1.1091, 1.2447, 1.6376, 2.5298, 3.8908};
  for (std::size_t i = 0; i < kCompliance.size(); ++i)
    EXPECT_NEAR(compliance_ratio(equal_strands(), kCompliance[i]), kRatio[i], 5e-5) << "1/D_t = " << kCompliance[i];
}

// The glued length solved as a two-point boundary-value problem by finite differences: outer strand force P1 each,
// centre strand force P - 2 P1, S tau' = difference of strains. This shares nothing with the closed form but the
// assumption that strands act through S.
double ratio_by_finite_differences(const Geometry& g, double compliance) {
  const double S = compliance + g.t1_mm / (3 * g.shear1_MPa()) + g.t2_mm / (6 * g.shear2_MPa());
  constexpr int n = 4000;
  const double dx = g.l_mm / n, A1 = g.t1_mm * g.E1_MPa, A2 = g.t2_mm * g.E2_MPa;  // per width, P = 1
  // tau = P1', S tau' = P1/A1 - (1 - 2 P1)/A2; P1(0) = 1/2 (the outer strands enter), P1(l) = 0.
  std::array<double, 2> ends{0.5, 0};
  std::vector<double> diagonal(n - 1, 2 + dx * dx / S * (1 / A1 + 2 / A2)), right(n - 1, dx * dx / (S * A2));
  right.front() += ends[0];
  right.back() += ends[1];
  for (int i = 1; i < n - 1; ++i) {
    diagonal[i] -= 1 / diagonal[i - 1];
    right[i] += right[i - 1] / diagonal[i - 1];
  }
  std::vector<double> force(n + 1);
  force[0] = ends[0];
  force[n] = ends[1];
  for (int i = n - 1; i >= 1; --i) force[i] = (right[i - 1] + (i + 1 < n ? force[i + 1] : 0)) / diagonal[i - 1];
  // Work of the external forces = complementary energy: 2 int P1^2/A1 + int P2^2/A2 + 2 int S tau^2 = u at P = 1.
  double energy = 0;
  for (int i = 0; i < n; ++i) {
    const double P1 = (force[i] + force[i + 1]) / 2, P2 = 1 - 2 * P1, tau = (force[i + 1] - force[i]) / dx;
    energy += dx * (2 * P1 * P1 / A1 + P2 * P2 / A2 + 2 * S * tau * tau);
  }
  return energy / (g.l_mm / (A2 + 2 * A1));
}

TEST(ShearLag, UnequalAdherendsAgreeWithTheSolvedDifferentialEquation) {
  for (double compliance : {0.0021, 0.01628, 0.06536})
    EXPECT_NEAR(
        compliance_ratio(unequal_strands(), compliance) / ratio_by_finite_differences(unequal_strands(), compliance), 1,
        1e-4);
}

TEST(ShearLag, DebondedSpecimenIsOnlyItsGlue) {
  // 1/D_t -> infinity: two glue areas l W in parallel, k = 2 l W D_t.
  const Geometry g = unequal_strands();
  EXPECT_NEAR(stiffness_N_per_mm(g, 1e6) * 1e6 / (2 * g.l_mm * g.W_mm), 1, 1e-5);
}

TEST(ShearLag, LowerBoundIsTheRigidBond) {
  for (const auto& g : {equal_strands(), unequal_strands()}) {
    const double bound = lower_bound_mm_per_MPa(g);
    EXPECT_NEAR(compliance_ratio(g, bound * (1 - 1e-12)), 1, 1e-5);
    EXPECT_NEAR(stiffness_N_per_mm(g, bound * (1 - 1e-12)) / rigid_limit_N_per_mm(g), 1, 1e-5);
  }
  // t/(3G) + t/(6G) with t = .69 and G = 9936/15.
  EXPECT_NEAR(lower_bound_mm_per_MPa(equal_strands()), -.69 / (2 * 662.4), 1e-12);
}

TEST(ShearLag, StiffnessInvertsForBothFormulas) {
  for (Formula formula : {Formula::kCoth, Formula::kLe2010}) {
    for (const auto& g : {equal_strands(), unequal_strands()}) {
      const double bound = lower_bound_mm_per_MPa(g);
      for (double compliance : {.99 * bound, .5 * bound, 0.0, 1e-4, .0021, .01628, .14645, 10.0, 1e4}) {
        const auto found = glue_compliance(g, stiffness_N_per_mm(g, compliance, formula), formula);
        ASSERT_TRUE(found.value_mm_per_MPa.has_value()) << found.reason;
        EXPECT_NEAR(*found.value_mm_per_MPa, compliance, 1e-10 - 1e-9 * bound + 1e-9 * std::abs(compliance));
      }
    }
  }
}

// Le's printed form has 1/D_t in place of the whole shear compliance in one term: 1/D_t changes by about 1 %.
TEST(ShearLag, PrintedFormulaDiffersByAboutOnePercent) {
  const Geometry g = equal_strands();
  for (double compliance : {.01048, .01628, .06536}) {
    const double printed = *glue_compliance(g, stiffness_N_per_mm(g, compliance), Formula::kLe2010).value_mm_per_MPa;
    EXPECT_GT(printed / compliance - 1, .002);
    EXPECT_LT(printed / compliance - 1, .02);
  }
}

TEST(ShearLag, StiffnessOutsideTheRangeHasAReason) {
  const Geometry g = equal_strands();
  EXPECT_NE(glue_compliance(g, 1.01 * rigid_limit_N_per_mm(g)).reason.find("rigid-bond limit"), std::string::npos);
  EXPECT_NE(glue_compliance(g, rigid_limit_N_per_mm(g)).reason.find("rigid-bond limit"), std::string::npos);
  EXPECT_NE(glue_compliance(g, 0).reason.find("not above zero"), std::string::npos);
  EXPECT_NE(glue_compliance(g, -120).reason.find("-120"), std::string::npos);
  EXPECT_FALSE(glue_compliance(g, std::nan("")).reason.empty());
  EXPECT_FALSE(glue_compliance(g, -120).value_mm_per_MPa.has_value());
}

TEST(ShearLag, SensitivityLimits) {
  Geometry g = equal_strands();
  EXPECT_EQ(sensitivity(g, 0), 0);
  EXPECT_NEAR(sensitivity(g, 1e5), -1, 1e-3);  // k = 2 l W D_t
  // Tabs only add a compliance that knows nothing of the glue.
  const double bare = sensitivity(g, .01628);
  g.L1_mm = g.L2_mm = 10;
  EXPECT_LT(std::abs(sensitivity(g, .01628)), .6 * std::abs(bare));
}

TEST(ShearLag, OnlyTheStiffnessErrorFollowsTheSensitivity) {
  const Geometry g = equal_strands();
  const auto propagated = propagate(g, .01628, {.01, 0, 0, 0});
  EXPECT_DOUBLE_EQ(propagated.k_equivalent, .01);
  EXPECT_NEAR(propagated.standard_mm_per_MPa, .01 * .01628 / std::abs(sensitivity(g, .01628)), 1e-9);
  EXPECT_LT(propagated.low_mm_per_MPa, .01628 - 1.9 * propagated.standard_mm_per_MPa);
  EXPECT_GT(propagated.high_mm_per_MPa, .01628 + 1.9 * propagated.standard_mm_per_MPa);
}

TEST(ShearLag, UniformModulusErrorActsLikeAStiffnessError) {
  // Without tabs k scales with E at fixed D_t E, so for stiff glue (1/D_t = 0) d ln k/d ln E1 + d ln k/d ln E2 = 1.
  const Geometry g = equal_strands();
  const double both = propagate(g, 0, {0, .01, 0, 0}).k_equivalent;
  EXPECT_GT(both, .01 / std::sqrt(2.0) * .999);  // equal shares would give .01/sqrt 2, unequal ones more
  EXPECT_LT(both, .01);
}

TEST(ShearLag, IntervalOfAStiffSpecimenEndsAtTheBound) {
  const Geometry g = equal_strands();
  EXPECT_EQ(propagate(g, .9 * lower_bound_mm_per_MPa(g), {.05, 0, 0, 0}).low_mm_per_MPa, lower_bound_mm_per_MPa(g));
}

TEST(ShearLag, ShortestOverlapIsBestUnlessItsLengthIsUncertain) {
  const Geometry g = equal_strands();
  const Design exact = best_overlap(g, .01628, {.01, .01, .01, 0}, 5, 50);
  EXPECT_NEAR(exact.overlap_mm, 5, .1);
  const Design measured = best_overlap(g, .01628, {.01, .01, .01, 0.5}, 1, 100);
  EXPECT_GT(measured.overlap_mm, 2);
  EXPECT_LT(measured.shortest_mm, measured.overlap_mm);
  EXPECT_GT(measured.longest_mm, measured.overlap_mm);
  Geometry best = g, shorter = g, longer = g;
  best.l_mm = measured.overlap_mm;
  shorter.l_mm = measured.overlap_mm * .9;
  longer.l_mm = measured.overlap_mm * 1.1;
  const Uncertainty u{.01, .01, .01, .5};
  const double least = propagate(best, .01628, u).standard_mm_per_MPa;
  EXPECT_LT(least, propagate(shorter, .01628, u).standard_mm_per_MPa);
  EXPECT_LT(least, propagate(longer, .01628, u).standard_mm_per_MPa);
  EXPECT_NEAR(measured.relative_uncertainty, least / .01628, 1e-9);
}

TEST(ShearLag, BadInputIsNamed) {
  EXPECT_THROW(best_overlap(equal_strands(), 0, {}, 5, 50), InputError);
  EXPECT_THROW(best_overlap(equal_strands(), .01, {}, 50, 5), InputError);
  EXPECT_THROW(formula_from_name("tanh"), InputError);
  EXPECT_EQ(formula_from_name("le2010"), Formula::kLe2010);
  Geometry g;
  g.t1_mm = -.69;
  EXPECT_EQ(fault(g), "t1_mm = -0.69 must be positive");
  g = {};
  g.L2_mm = -1;
  EXPECT_EQ(fault(g), "L2_mm = -1 must not be negative");
  EXPECT_EQ(fault({}), "");
}

}  // namespace
}  // namespace strandlab::bondline
