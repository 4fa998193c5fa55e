#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "strandlab/core/error.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::vtest {
namespace {

struct StrandOfRow {
  int row;
  double x0, x1;
};

// Strands of poplar, 0.8 mm thick, in a window of 20 mm.
Panel<2> panel_with(const std::vector<StrandOfRow>& pieces, double angle_deg = 0) {
  mat::Mat mat;
  mat.length_mm = 20;
  mat.layer_thickness_mm = 0.8;
  for (const auto& piece : pieces) {
    while (static_cast<int>(mat.layers.size()) <= piece.row) mat.layers.emplace_back().role = "surface";
    auto& strand = mat.layers[piece.row].strands.emplace_back();
    strand.x0_mm = piece.x0;
    strand.x1_mm = piece.x1;
  }
  return make_panel(mat, {{"surface", wood::Material{}, angle_deg}}, 0.8 / 6, 6);
}

Panel<2> laminate() {
  return panel_with({{0, 0, 20}, {1, 0, 20}, {2, 0, 20}});
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

// Bonds of half their strength at 1/D_t = .01 are those of .01/.5 + (1/.5 - 1) .0105 = .0305 fully cured, and a perfect
// bond of half its strength is one of .0105.
TEST(Measure, TakesBondsAsFarAsTheyHaveCured) {
  const auto whole = panel_with({{0, 0, 12.4}, {1, 7.1, 20}});
  auto half = whole;
  for (auto& strand : half.strands) strand.points.bond_quality.assign(strand.size(), .5);
  Options options;
  options.kinds = {TestKind::kTension};
  options.compliance_t_mm_per_MPa = {.01, 0};
  const auto given = measure(half, options);
  options.compliance_t_mm_per_MPa = {.0305, .0105};
  const auto expected = measure(whole, options);
  ASSERT_EQ(given.moduli.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(given.moduli[i].modulus_MPa / expected.moduli[i].modulus_MPa, 1, 1e-9);
}

TEST(TestKind, HasANameThatLeadsBack) {
  for (const TestKind kind : {TestKind::kTension, TestKind::kBendingEndRotation, TestKind::kBendingEndCouple,
                              TestKind::kBending3Point, TestKind::kBending4Point}) {
    EXPECT_EQ(test_from_name(name(kind)), kind);
  }
  EXPECT_EQ(test_names().size(), 5U);
  const auto message = message_of([] { test_from_name("torsion"); });
  EXPECT_NE(message.find("torsion"), std::string::npos);
  EXPECT_NE(message.find("tension, bending_end_rotation, bending_end_couple, bending_3_point, bending_4_point"),
            std::string::npos);
}

// Gap-free strands at 0, 45 and 90 degrees to the section: plane-strain moduli of a row, 10003.3, 3379.3 and 429.9 MPa.
TEST(Measure, GivesTheModulusOfTheWoodItself) {
  for (const auto& [angle, modulus] : {std::pair{0.0, 10003.3}, std::pair{45.0, 3379.3}, std::pair{90.0, 429.9}}) {
    const auto result = measure(panel_with({{0, 0, 20}, {1, 0, 20}}, angle), {});
    ASSERT_EQ(result.moduli.size(), 2U);
    for (const auto& m : result.moduli) EXPECT_NEAR(m.modulus_MPa, modulus, 0.1) << name(m.kind) << " at " << angle;
    EXPECT_NEAR(result.glued_fraction, 1, 1e-9);
    EXPECT_EQ(result.floating_strands, 0);
    EXPECT_TRUE(result.warnings.empty());
  }
}

// By kind within compliance, in the order asked for.
TEST(Measure, ReportsInTheOrderAskedFor) {
  Options options;
  options.kinds = {TestKind::kBendingEndCouple, TestKind::kTension};
  options.compliance_t_mm_per_MPa = {0.05, 0};
  const auto result = measure(laminate(), options);
  ASSERT_EQ(result.moduli.size(), 4U);
  EXPECT_EQ(result.moduli[0].kind, TestKind::kBendingEndCouple);
  EXPECT_EQ(result.moduli[1].kind, TestKind::kTension);
  EXPECT_EQ(result.moduli[1].compliance_t_mm_per_MPa, 0.05);
  EXPECT_EQ(result.moduli[2].compliance_t_mm_per_MPa, 0);
  EXPECT_GT(result.unknowns, 0);
}

// The strand in the middle row hangs on the left strand only: it is not connected to the right end and carries nothing.
TEST(Measure, DropsStrandsThatFloat) {
  const auto result = measure(panel_with({{0, 0, 20}, {2, 0, 6}, {3, 5, 12}}), {});
  EXPECT_EQ(result.strands, 3);
  EXPECT_EQ(result.floating_strands, 2);
  // One strand of 0.8 mm carries the tension of a panel 3.2 mm thick.
  EXPECT_NEAR(result.moduli[0].modulus_MPa, 10003.3 / 4, 0.1);
}

// Two stacks that do not touch, both between the end planes: in tension they simply add up.
TEST(Measure, HoldsGroupsThatDoNotTouch) {
  const auto result = measure(panel_with({{0, 0, 20}, {2, 0, 20}}), {});
  EXPECT_EQ(result.floating_strands, 0);
  EXPECT_NEAR(result.moduli[0].modulus_MPa, 10003.3 * 2 / 3, 0.1);
}

// The window is the specimen: of strands that free sides let out of it, what lies outside is cut off. Here an evenly
// stretched stack, 3 mm longer than the window at both ends, and a strand wholly outside.
TEST(Measure, CutsTheSpecimenAtTheWindow) {
  Options options;
  const auto inside = measure(panel_with({{0, 0, 20}, {1, 0, 20}}), options);
  auto panel = panel_with({{0, 0, 18}, {0, 18.1, 20}, {1, 0, 20}});
  const double stretch = 1.3;  // about the middle: ends at -3 and 23 mm; the short strand from 20.53 mm
  for (auto& strand : panel.strands) {
    for (auto& x : strand.points.x) x[0] = 10 + stretch * (x[0] - 10);
    for (auto& F : strand.points.F) F(0, 0) = stretch;
  }
  const auto cut = measure(panel, options);
  ASSERT_EQ(cut.warnings.size(), 1U);
  EXPECT_NE(cut.warnings[0].find("3 mm beyond"), std::string::npos) << cut.warnings[0];
  EXPECT_NE(cut.warnings[0].find("1 whole strand"), std::string::npos) << cut.warnings[0];
  EXPECT_EQ(cut.floating_strands, 0);
  ASSERT_FALSE(cut.slips.empty());
  EXPECT_EQ(cut.slips.front().b, 2);  // as in the panel, without the strand outside
  // Density, and with it stiffness per volume, fell by the stretch; nothing else did.
  for (std::size_t i = 0; i < cut.moduli.size(); ++i)
    EXPECT_NEAR(cut.moduli[i].modulus_MPa * stretch / inside.moduli[i].modulus_MPa, 1, 2e-3)
        << name(cut.moduli[i].kind);
}

TEST(Measure, SaysWhenNothingConnectsTheEnds) {
  const auto message = message_of([] { measure(panel_with({{0, 0, 9}, {1, 12, 20}}), {}); });
  EXPECT_NE(message.find("connect the two ends"), std::string::npos);
}

// A lap joint whose glue is soft: the strands (500 N/mm each) hardly stretch beside a joint of D_t times overlap = 0.4
// N/mm, so that it slides by the whole elongation of 20 mm per unit strain; the upper strand goes with x. The softest
// glue is the one reported. A perfect bond does not slide.
TEST(Measure, TellsHowFarGlueLinesSlide) {
  Options options;
  options.compliance_t_mm_per_MPa = {0, 10, 0.1};
  const auto lap = panel_with({{0, 0, 12}, {1, 8, 20}});
  const auto result = measure(lap, options);
  EXPECT_EQ(result.slip_compliance_t_mm_per_MPa, 10);
  ASSERT_GT(result.slips.size(), 10U);
  for (const auto& s : result.slips) {
    EXPECT_EQ(s.a, 0);
    EXPECT_EQ(s.b, 1);
    EXPECT_NEAR(s.position[1], 0.8, 1e-9);
    EXPECT_TRUE(s.position[0] > 8 - 1e-9 && s.position[0] < 12 + 1e-9) << s.position[0];
    EXPECT_NEAR(s.slip_mm_per_strain, 20, 0.1);
  }
  options.compliance_t_mm_per_MPa = {0};
  for (const auto& s : measure(lap, options).slips) EXPECT_NEAR(s.slip_mm_per_strain, 0, 1e-3);
  options.kinds = {TestKind::kBendingEndRotation};
  EXPECT_TRUE(measure(lap, options).slips.empty());
}

// A lap joint whose strands slide: the force of the joint is D_t times slip times overlap, here with the floor D_t =
// 1e-3 MPa/mm in place of 1/D_t = 1e9. The strands are rigid by comparison.
TEST(Measure, RaisesGlueThatIsTooSoftToTheFloorAndSaysSo) {
  Options options;
  options.compliance_t_mm_per_MPa = {1e9};
  options.kinds = {TestKind::kTension};
  const auto result = measure(panel_with({{0, 0, 12}, {1, 8, 20}}), options);
  EXPECT_NEAR(result.moduli[0].modulus_MPa, 1e-3 * 4 * 20 / 1.6, 1e-3 * 0.05);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings[0].find("0.001 MPa/mm"), std::string::npos);
}

// Measured compliances of very good bonds come out slightly negative.
TEST(Measure, TakesANegativeComplianceAsAPerfectBond) {
  Options options;
  options.compliance_t_mm_per_MPa = {0, -0.00022};
  const auto result = measure(panel_with({{0, 0, 12}, {1, 8, 20}}), options);
  EXPECT_DOUBLE_EQ(result.moduli[0].modulus_MPa, result.moduli[2].modulus_MPa);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings[0].find("negative"), std::string::npos);
}

// A glue line that opens easily costs stiffness, as one that shears easily does.
TEST(Measure, FeelsTheNormalCompliance) {
  Options options;
  const auto rigid = measure(panel_with({{0, 0, 12}, {1, 8, 20}}), options);
  options.compliance_n_mm_per_MPa = 0.05;
  const auto soft = measure(panel_with({{0, 0, 12}, {1, 8, 20}}), options);
  EXPECT_LT(soft.moduli[0].modulus_MPa, 0.99 * rigid.moduli[0].modulus_MPa);
}

// The couple acts on the outermost strands that reach the loaded end: a short strand on top does not, so both panels
// see the same.
TEST(Measure, AppliesTheCoupleToStrandsThatReachTheLoadedEnd) {
  Options options;
  options.kinds = {TestKind::kBendingEndCouple};
  const auto message = message_of([&] { measure(panel_with({{0, 0, 20}, {1, 0, 12}}), options); });
  EXPECT_NE(message.find("two strands at the loaded end"), std::string::npos);
  const auto with_short_top = measure(panel_with({{0, 0, 20}, {1, 0, 20}, {2, 0, 1}}), options);
  const auto without = measure(panel_with({{0, 0, 20}, {1, 0, 20}}), options);
  // The short strand stiffens the clamped end a little; the modulus is per h^3, and h is 1.5 times as large.
  EXPECT_NEAR(with_short_top.moduli[0].modulus_MPa * 3.375 / without.moduli[0].modulus_MPa, 1.03, 0.03);
}

// One row of 0.8 mm in a window of 20 mm, at a span of 23 thicknesses: exactly span and a thickness beyond the
// supports.
TEST(Measure, BendsOnSupportsWhatIsLongEnough) {
  Options options;
  options.kinds = {TestKind::kBending4Point, TestKind::kBending3Point, TestKind::kTension};
  options.span_to_thickness = 23;
  const auto result = measure(panel_with({{0, 0, 20}}), options);
  EXPECT_EQ(result.moduli[0].kind, TestKind::kBending4Point);
  EXPECT_EQ(result.moduli[1].kind, TestKind::kBending3Point);
  for (int i = 0; i < 2; ++i)  // three elements through the whole beam
    EXPECT_NEAR(*result.moduli[i].shear_free_modulus_MPa, 10003.3, 50) << name(result.moduli[i].kind);
  EXPECT_FALSE(result.moduli[2].shear_free_modulus_MPa.has_value());
  options.span_to_thickness = 23.1;
  const auto message = message_of([&] { measure(panel_with({{0, 0, 20}}), options); });
  for (const char* part : {"23.1 thicknesses of 0.80 mm", "needs a panel 21 mm long", "this one has 20 mm"})
    EXPECT_NE(message.find(part), std::string::npos) << part << " in " << message;
}

TEST(Measure, BendsOnSupportsOnlyWhatIsInOnePiece) {
  Options options;
  options.kinds = {TestKind::kBending3Point};
  options.span_to_thickness = 6.25;
  const auto stacks = panel_with({{0, 0, 20}, {2, 0, 20}});
  EXPECT_NE(message_of([&] { measure(stacks, options); }).find("6.25 thicknesses"), std::string::npos);
  options.span_to_thickness = 8;
  options.pad_to_thickness = 0;
  auto panel = panel_with({{0, 0, 20}});
  EXPECT_NE(message_of([&] { measure(panel, options); }).find("pads of 0 thicknesses"), std::string::npos);
  options.pad_to_thickness = 0.5;
  panel = stacks;
  for (auto& strand : panel.strands) {  // a window of 40 mm
    for (auto& x : strand.points.x) x[0] *= 2;
    for (auto& F : strand.points.F) F(0, 0) = 2;
  }
  panel.length_mm = 40;
  EXPECT_NE(message_of([&] { measure(panel, options); }).find("in 2 that no glue connects"), std::string::npos);
}

// A lap joint whose faces open from 0 at x = 8 to 0.24 mm at x = 20: the glued length is proportional to the curing
// gap, and with soft glue and stiff strands so is the tension modulus.
TEST(GapSensitivity, TellsWhatHalfAndTwiceTheGapDo) {
  auto panel = panel_with({{0, 0, 20}, {1, 8, 20}, {2, 8, 20}, {3, 8, 20}});
  panel.strands.erase(panel.strands.begin() + 2, panel.strands.end());
  for (auto& x : panel.strands[0].points.x) x[0] *= 0.99;  // does not reach the right end
  for (auto& F : panel.strands[0].points.F) F(0, 0) = 0.99;
  for (auto& x : panel.strands[1].points.x) x[1] += 0.02 * (x[0] - 8);
  for (auto& F : panel.strands[1].points.F) F(1, 0) = 0.02;
  Options options;
  options.kinds = {TestKind::kTension};
  options.compliance_t_mm_per_MPa = {100};
  const auto sensitivity = gap_sensitivity(panel, options);
  EXPECT_NEAR(sensitivity.halved, -0.5, 0.02);
  EXPECT_NEAR(sensitivity.doubled, 1, 0.02);
}

TEST(Measure, RejectsOptionsItCannotUse) {
  const auto reject = [](const std::function<void(Options&)>& change, const char* part) {
    Options options;
    change(options);
    EXPECT_NE(message_of([&] { measure(laminate(), options); }).find(part), std::string::npos) << part;
  };
  reject([](Options& o) { o.kinds.clear(); }, "bending_end_rotation");
  reject([](Options& o) { o.compliance_t_mm_per_MPa.clear(); }, "1/D_t");
  reject([](Options& o) { o.compliance_t_mm_per_MPa = {std::nan("")}; }, "1/D_t");
  reject([](Options& o) { o.compliance_n_mm_per_MPa = std::nan(""); }, "1/D_n");
  reject([](Options& o) { o.elements_through_strand = 0; }, "1 to 48");
  reject([](Options& o) { o.elements_through_strand = 1000; }, "1 to 48");
  reject([](Options& o) { o.curing.max_gap_mm = -1; }, "curing gap");
  reject([](Options& o) { o.perfect_bond = 0; }, "perfect bond");
  EXPECT_NE(message_of([] { measure(Panel<2>{}, {}); }).find("no strands"), std::string::npos);
}

}  // namespace
}  // namespace strandlab::vtest
