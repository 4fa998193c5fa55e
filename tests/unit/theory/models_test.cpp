#include "strandlab/theory/models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/theory/estimate.hpp"

namespace strandlab::theory {
namespace {

// Unmodified hybrid poplar.
const wood::Material& poplar() {
  return wood::library().front();
}

Row full_row(double angle_deg = 0) {
  return {poplar(), angle_deg, {0, 0, 0, 0}, .8, 0};
}

// E_S = 9936 * 150/165 = 9032.7 and E_C = 427 * 25/35 = 305 MPa, half of each: 4668.9 MPa.
TEST(Theory, TensionOfTheDefaultOsb) {
  EXPECT_NEAR(tension_modulus_MPa(default_osb(), 0), 4669, .5);
  EXPECT_NEAR(tension_modulus_MPa(default_osb(), 0.4), 4668.86 / .6, .1);
}

// Three layers, half the volume each surface and core: E_b = E_S (7/8 + 1/(8R)), R = E_S/E_C, E_S = 9936, E_C = 423.
TEST(Theory, BendingOfThreeLayersWithoutGaps) {
  std::vector<double> moduli(20, 9936);
  std::fill(moduli.begin() + 5, moduli.begin() + 15, 423);
  EXPECT_NEAR(bending_of_moduli_MPa(moduli, 0), 8747, .5);
  EXPECT_NEAR(bending_of_moduli_MPa(moduli, .2), 8746.9 / .8, .2);
}

TEST(Theory, BendingOfAPanelOfOneKindIsItsTension) {
  EXPECT_NEAR(bending_of_moduli_MPa({9936, 9936, 9936}, 0), 9936, 1e-9);
  // A layer without stiffness leaves a beam of half the height: 1/8 of the stiffness, about its own middle.
  EXPECT_NEAR(bending_of_moduli_MPa({0, 0, 8000, 8000}, 0), 1000, 1e-9);
}

TEST(Theory, RandomCoreOfUnmodifiedStrands) {
  EXPECT_NEAR(quasi_isotropic_modulus_MPa(poplar()), 4022, .5);
  EXPECT_NEAR(off_axis_average_MPa(poplar()), 2483, .5);
  EXPECT_NEAR(plane_strain_average_MPa(poplar()), 4297.9, .05);
}

TEST(Theory, PlaneStrainModulusOfARow) {
  EXPECT_NEAR(plane_strain_modulus_MPa(poplar(), 0), 10003.3, .05);
  EXPECT_NEAR(plane_strain_modulus_MPa(poplar(), 45), 3379.3, .05);
  EXPECT_NEAR(plane_strain_modulus_MPa(poplar(), -45), 3379.3, .05);
  EXPECT_NEAR(plane_strain_modulus_MPa(poplar(), 90), 429.9, .05);
}

TEST(Theory, OffAxisModulusEndsAtTheGrain) {
  EXPECT_NEAR(off_axis_modulus_MPa(poplar(), 0), poplar().E_L, 1e-9);
  EXPECT_NEAR(off_axis_modulus_MPa(poplar(), 90), poplar().E_T, 1e-9);
  EXPECT_NEAR(off_axis_modulus_MPa(poplar(), 30), off_axis_modulus_MPa(poplar(), -30), 1e-9);
}

// An isotropic material has one modulus in every direction; in plane strain E/(1 - nu^2).
TEST(Theory, IsotropicStrandsDoNotKnowTheirAngle) {
  const double G = 11000 / 2.66;
  wood::Material isotropic = poplar();
  isotropic.E_L = isotropic.E_R = isotropic.E_T = 11000;
  isotropic.G_RL = isotropic.G_TL = isotropic.G_RT = G;
  isotropic.nu_RL = isotropic.nu_TL = isotropic.nu_TR = .33;
  EXPECT_NEAR(quasi_isotropic_modulus_MPa(isotropic), 11000, 1e-6);
  EXPECT_NEAR(off_axis_average_MPa(isotropic), 11000, 1e-6);
  EXPECT_NEAR(plane_strain_average_MPa(isotropic), 11000 / (1 - .33 * .33), 1e-6);
}

// Inputs of Le (2010) Fig. 5.8 at aspect ratio 100.
TEST(Theory, ShearLagAtAspectRatioHundred) {
  const ShearLag strands{9936, 743, .83, 1500, 500, 80, .8};
  EXPECT_NEAR(shear_lag_modulus_MPa(strands, 0), 8445, .5);
  EXPECT_NEAR(shear_lag_modulus_MPa(strands, 1.0 / 100), 8206, .5);
  EXPECT_NEAR(shear_lag_modulus_MPa(strands, 1.0 / 60), 8123, .5);
}

TEST(Theory, ShearLagLimits) {
  ShearLag strands{9936, 743, .83, 1500, 500, 80, .8};
  strands.length_mm = 1e7;
  EXPECT_NEAR(shear_lag_modulus_MPa(strands, .01), 9936 * .83 + 1500 * .17, .1);  // long strands: rule of mixtures
  strands.length_mm = 1e-5;
  EXPECT_NEAR(shear_lag_modulus_MPa(strands, .01), 1500 * .17, 1e-6);  // short strands carry nothing
  strands.length_mm = 80;
  EXPECT_NEAR(shear_lag_modulus_MPa(strands, 1e9), 1500 * .17, 1e-3);  // debonded strands neither
  strands.V_w = 1;
  EXPECT_EQ(shear_lag_modulus_MPa(strands, .01), 9936);  // a row without gaps
  strands.V_w = 0;
  EXPECT_EQ(shear_lag_modulus_MPa(strands, .01), 1500);  // a row without strands
  EXPECT_THROW(strand_efficiency({9936, 743, .83, 1500, 500, 80, .8}, -.01), InputError);
}

TEST(Theory, ShearLagPanelKeepsTheCore) {
  const auto rows = default_osb();
  const double expected =
      (shear_lag_modulus_MPa({9936, 745, 150.0 / 165, 1500, 500, 150, .8}, .01628) + 427 * 25.0 / 35) / 2;
  EXPECT_NEAR(shear_lag_panel_MPa(rows, {}, .01628, 0), expected, 1e-9);
  EXPECT_NEAR(shear_lag_panel_MPa(rows, {}, .01628, .3), expected / .7, 1e-9);
}

// A row twice as thick is two rows, wherever it lies; in tension and density its share counts, in bending its place
// too.
TEST(Theory, AThickRowIsSeveralThinOnes) {
  const Row vtc{wood::library()[1], 0, {0, 0, 0, 0}, .4, 0};
  Row thick = vtc;
  thick.thickness_mm = 1.2;
  const std::vector<Row> thin{vtc, vtc, vtc, full_row(90), full_row()}, mixed{thick, full_row(90), full_row()};
  for (const auto choice : {OffAxis::kExact, OffAxis::kUncoupled}) {
    EXPECT_NEAR(tension_modulus_MPa(mixed, .1, choice), tension_modulus_MPa(thin, .1, choice), 1e-8);
    EXPECT_NEAR(bending_modulus_MPa(mixed, .1, choice), bending_modulus_MPa(thin, .1, choice), 1e-8);
    EXPECT_NEAR(random_core_modulus_MPa(mixed, 4000, .1, choice), random_core_modulus_MPa(thin, 4000, .1, choice),
                1e-8);
  }
  EXPECT_NEAR(density_kg_m3(mixed, 0), (910 * 1.2 + 350 * 1.6) / 2.8, 1e-10);
  EXPECT_NEAR(tension_modulus_MPa(mixed, 0), (24311 * 1.2 + (9936 + 427) * .8) / 2.8, 1e-8);
}

// Where the strands of a row are known, each counts by its length, with its own wood and angle.
TEST(Theory, RowsOfKnownStrands) {
  const auto& vtc = wood::library()[1];
  Row row = full_row();
  row.pieces = {{poplar(), 0, 50}, {vtc, 90, 25}, {poplar(), -30, 25}};
  const double expected = .5 * 9936 + .25 * 1005 + .25 * off_axis_modulus_MPa(poplar(), 30);
  EXPECT_NEAR(tension_modulus_MPa({row}, .2), expected / .8, 1e-8);
  EXPECT_NEAR(density_kg_m3({row}, 0), .75 * 350 + .25 * 910, 1e-10);
  EXPECT_FALSE(runs_along(row));
  row.pieces[1].angle_deg = 170;
  EXPECT_TRUE(runs_along(row));
  Row same = full_row(30);
  same.pieces = {{poplar(), 30, 7}, {poplar(), 30, 1}};
  EXPECT_NEAR(tension_modulus_MPa({same}, 0, OffAxis::kExact), plane_strain_modulus_MPa(poplar(), 30), 1e-9);
}

// Rows of strands at any angle have the mean over angles, and are core; a narrow spread about the section is not.
TEST(Theory, RowsOfRandomAngles) {
  Row core = full_row();
  core.angle_spread_deg = 90;
  EXPECT_NEAR(tension_modulus_MPa({core}, 0, OffAxis::kExact), 4297.9, .05);
  EXPECT_NEAR(tension_modulus_MPa({core}, 0), 2483, .5);
  EXPECT_FALSE(runs_along(core));
  core.angle_spread_deg = 20;
  EXPECT_TRUE(runs_along(core));
  // Second order in a small spread: the mean over +-d of E(angle) is E(0) + E''(0) d^2/6.
  core.angle_spread_deg = .1;
  const double second = (off_axis_modulus_MPa(poplar(), 1) - poplar().E_L) * 2;  // per square degree
  EXPECT_NEAR(tension_modulus_MPa({core}, 0), poplar().E_L + second * .01 / 6, 1e-3);
}

// Normal angles: of a small standard deviation s the mean is E(0) + E''(0) s^2/2; of a large one it is that of any
// angle.
TEST(Theory, RowsOfNormalAngles) {
  Row row = full_row();
  row.angle_sd_deg = .1;
  const double second = (off_axis_modulus_MPa(poplar(), 1) - poplar().E_L) * 2;       // per square degree
  EXPECT_NEAR(tension_modulus_MPa({row}, 0), poplar().E_L + second * .01 / 2, 2e-3);  // second is good to 3e-3
  EXPECT_TRUE(runs_along(row));
  row.angle_sd_deg = 90;
  EXPECT_NEAR(tension_modulus_MPa({row}, 0, OffAxis::kExact) / plane_strain_average_MPa(poplar()), 1, .02);
  EXPECT_FALSE(runs_along(row));
}

TEST(Theory, DensityAndModulusGrowTogether) {
  const auto rows = default_osb();
  EXPECT_NEAR(density_kg_m3(rows, 0), 350 * (150.0 / 165 + 25.0 / 35) / 2, 1e-9);
  EXPECT_NEAR(density_kg_m3(rows, .4), density_kg_m3(rows, 0) / .6, 1e-9);
  for (double compaction : {0.0, .2, .4})
    EXPECT_NEAR(modulus_at_density_MPa(rows, density_kg_m3(rows, compaction)), tension_modulus_MPa(rows, compaction),
                1e-9);
}

TEST(Theory, RowsOffTheGrain) {
  EXPECT_TRUE(runs_along(full_row(0)) && runs_along(full_row(30)) && runs_along(full_row(180)));
  EXPECT_FALSE(runs_along(full_row(90)) || runs_along(full_row(60)));
  EXPECT_NEAR(tension_modulus_MPa({full_row(45)}, 0, OffAxis::kExact), 3379.3, .05);
  EXPECT_NEAR(tension_modulus_MPa({full_row(45)}, 0), off_axis_modulus_MPa(poplar(), 45), 1e-9);
  EXPECT_NEAR(random_core_modulus_MPa({full_row(0), full_row(90)}, 4000, 0), (9936 + 4000) / 2.0, 1e-9);
}

TEST(Theory, BadInputIsNamed) {
  EXPECT_THROW(tension_modulus_MPa({full_row()}, 1), InputError);
  EXPECT_THROW(tension_modulus_MPa({full_row()}, -.1), InputError);
  EXPECT_THROW(tension_modulus_MPa({}, 0), InputError);
  EXPECT_THROW(bending_modulus_MPa({}, 0), InputError);
  EXPECT_THROW(density_kg_m3({}, 0), InputError);
  EXPECT_THROW(modulus_at_density_MPa({full_row()}, 100), InputError);
  EXPECT_THROW(wood::off_axis_from_name("none"), InputError);
  EXPECT_EQ(wood::off_axis_from_name("exact"), OffAxis::kExact);
}

TEST(Estimate, EveryModelAtEveryCombination) {
  Question question;
  question.rows = default_osb();
  question.compactions = {0, .2};
  question.compliances_t = {0, .0021, .01628};
  question.lengths_mm = {50, 150};
  question.gaps_mm = {0, 15};
  question.densities_kg_m3 = {500};
  const auto all = estimate(question);
  const auto count = [&](const std::string& model) {
    return std::count_if(all.begin(), all.end(), [&](const Estimate& e) { return e.model == model; });
  };
  EXPECT_EQ(count("tension"), 8);  // 2 compactions x 2 lengths x 2 gaps
  EXPECT_EQ(count("bending"), 8);
  EXPECT_EQ(count("shear_lag"), 24);
  EXPECT_EQ(count("modulus_at_density"), 4);
  EXPECT_EQ(count("random_core_off_axis"), 8);
  const auto last = std::find_if(all.begin(), all.end(), [](const Estimate& e) {
    return e.model == "tension" && e.compaction == 0 && e.length_mm == 150 && e.gap_mm == 15;
  });
  ASSERT_NE(last, all.end());
  EXPECT_NEAR(last->modulus_MPa, 4669, .5);
  for (const auto& e : all)
    EXPECT_TRUE(std::any_of(models().begin(), models().end(), [&](const Model& m) { return m.name == e.model; }));
}

TEST(Estimate, PanelsWithoutCoreHaveNoRandomCore) {
  Question question;
  question.rows = {full_row(), full_row()};
  for (const auto& e : estimate(question)) EXPECT_EQ(e.model.find("random_core"), std::string::npos);
  question.rows = {full_row(90)};
  for (const auto& e : estimate(question)) EXPECT_NE(e.model, "shear_lag");
}

TEST(Estimate, BadListsAreNamed) {
  Question question;
  question.rows = default_osb();
  question.lengths_mm = {0};
  EXPECT_THROW(estimate(question), InputError);
  question.lengths_mm.clear();
  question.gaps_mm = {-1};
  EXPECT_THROW(estimate(question), InputError);
  question.rows = {full_row()};
  question.gaps_mm = {5};  // a gap needs a strand length
  EXPECT_THROW(estimate(question), InputError);
  question.rows = {full_row(90)};
  EXPECT_THROW(estimate(question), InputError);
  question.gaps_mm.clear();
  question.rows.front().thickness_mm = 0;
  EXPECT_THROW(estimate(question), InputError);
}

}  // namespace
}  // namespace strandlab::theory
