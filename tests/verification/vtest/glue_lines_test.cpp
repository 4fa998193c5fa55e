// Properties of the moduli that do not need a reference: symmetry, continuity, penalty, undulated glue lines.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/report.hpp"
#include "verification/vtest/reference_panels.hpp"

namespace strandlab::vtest {
namespace {

Options options_with(std::vector<double> compliances,
                     std::vector<TestKind> kinds = {TestKind::kTension, TestKind::kBendingEndRotation}) {
  Options options;
  options.kinds = std::move(kinds);
  options.compliance_t_mm_per_MPa = std::move(compliances);
  return options;
}

void expect_same(const std::string& what, const Result& a, const Result& b, const test::Limit& limit) {
  ASSERT_EQ(a.moduli.size(), b.moduli.size());
  double worst = 0;
  for (std::size_t i = 0; i < a.moduli.size(); ++i) {
    const double ratio = a.moduli[i].modulus_MPa / b.moduli[i].modulus_MPa;
    worst = std::max(worst, std::abs(ratio - 1));
  }
  report(what + ": largest change of a modulus", worst, limit);
}

// Undulated laminate of four rows, A sin(2 pi x/w), 25 mm long: tension moduli of an independent finite-element
// solution with six elements per strand.
struct Undulation {
  double amplitude_mm, wave_mm;
  std::vector<double> compliances, moduli;
};

constexpr const char* kReferenceAsPrinted = "one limit for all 1/D_t; the reference is rounded to 1 MPa";

class UndulatedLaminate : public testing::TestWithParam<Undulation> {};

TEST_P(UndulatedLaminate, FollowsTheReference) {
  const auto& u = GetParam();
  const auto panel = undulated_laminate(4, 25, u.amplitude_mm, u.wave_mm);
  for (const auto& [elements, tolerance] : {std::pair{6, 0.003}, std::pair{3, 0.03}}) {
    auto options = options_with(u.compliances, {TestKind::kTension});
    options.elements_through_strand = elements;
    const auto result = measure(panel, options);
    EXPECT_NEAR(result.glued_fraction, 1, 1e-6);
    for (std::size_t i = 0; i < u.moduli.size(); ++i) {
      report(fmt::format("undulated laminate, A = {}, w = {} mm, 1/D_t = {}, {} elements: tension modulus",
                         u.amplitude_mm, u.wave_mm, u.compliances[i], elements),
             result.moduli[i].modulus_MPa, near(u.moduli[i], tolerance * u.moduli[i]).because(kReferenceAsPrinted),
             "MPa");
      EXPECT_NEAR(result.moduli[i].modulus_MPa / result.moduli[i].reaction_modulus_MPa, 1, 1e-6);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Waves, UndulatedLaminate,
                         testing::Values(Undulation{0.5, 25, {0, 0.0021, 0.0163, 0.05}, {8018, 7035, 5157, 4158}},
                                         Undulation{0.25, 5, {0, 0.0163}, {6311, 4793}}));

// A strand that reaches further into a gap stiffens the panel little by little: steps of a tenth of an element change a
// modulus by no more than 1e-4 and evenly (second difference), also where the number of elements or of glue points
// changes.
TEST(StrandEnds, MoveModuliContinuously) {
  auto mat = reference_mat("osb_s1");
  const double tenth = 0.8 / 3 / 10;
  std::vector<Result> results;
  for (int step = 0; step <= 12; ++step) {
    mat.layers[1].strands[0].x1_mm = 22.4 + step * tenth;
    results.push_back(measure(panel_of(mat), options_with({0, 0.0021})));
  }
  double step = 0, kink = 0;
  for (std::size_t i = 0; i < results[0].moduli.size(); ++i) {
    for (std::size_t k = 2; k < results.size(); ++k) {
      const double before = results[k - 2].moduli[i].modulus_MPa, middle = results[k - 1].moduli[i].modulus_MPa;
      const double now = results[k].moduli[i].modulus_MPa;
      step = std::max(step, (now - middle) / now);
      kink = std::max(kink, std::abs(now - 2 * middle + before) / now);
      EXPECT_GT(now, middle);
    }
  }
  report("strand end moved by tenths of an element: largest relative step of a modulus", step, below(1e-4));
  report("strand end moved by tenths of an element: largest second difference", kink, below(6e-5));
}

mat::Mat mirrored_along(mat::Mat mat) {
  for (auto& layer : mat.layers) {
    std::reverse(layer.strands.begin(), layer.strands.end());
    for (auto& s : layer.strands) {
      const double x0 = mat.length_mm - s.x1_mm;
      s.x1_mm = mat.length_mm - s.x0_mm;
      s.x0_mm = x0;
    }
  }
  return mat;
}

TEST(Mirroring, ChangesNoModulus) {
  for (const char* name : {"osb_fine_s11", "osl_s1"}) {
    const auto mat = reference_mat(name);
    auto upside_down = mat;
    std::reverse(upside_down.layers.begin(), upside_down.layers.end());
    const auto options = options_with({0, 0.0163});
    const auto original = measure(panel_of(mat), options);
    expect_same(std::string(name) + " mirrored along x", measure(panel_of(mirrored_along(mat)), options), original,
                below(5e-6).because("ends off the lattice are drawn onto it from the left"));
    expect_same(std::string(name) + " upside down", measure(panel_of(upside_down), options), original,
                below(1e-9).because(test::kRoundOff));
  }
}

// Perfect bonds are springs: ten times stiffer ones change nothing that matters, in flat mats and on undulated lines.
TEST(PerfectBond, DoesNotDependOnItsPenalty) {
  for (const auto& [what, panel] : {std::pair{"osl_s1", panel_of(reference_mat("osl_s1"))},
                                    std::pair{"undulated laminate", undulated_laminate(4, 25, 0.25, 5)}}) {
    auto options = options_with({0, 0.0105}, kinds_on_end_planes());
    const auto usual = measure(panel, options);
    options.perfect_bond *= 10;
    expect_same(fmt::format("{}, penalty of a perfect bond times ten", what), measure(panel, options), usual,
                below(4e-8));
  }
}

// On the way from a perfect bond to loose strands a modulus falls steadily, and a bond of D = 1e5 MPa/mm is as good as
// perfect.
TEST(GlueCompliance, LowersEveryModulus) {
  const std::vector<double> compliances{0, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1, 10};
  const auto result = measure(panel_of(reference_mat("osb_s1")), options_with(compliances, kinds_on_end_planes()));
  for (const TestKind kind : kinds_on_end_planes()) {
    EXPECT_NEAR(find(result, kind, 1e-5).modulus_MPa / find(result, kind, 0).modulus_MPa, 1, 1e-3);
    for (std::size_t i = 1; i < compliances.size(); ++i) {
      EXPECT_LT(find(result, kind, compliances[i]).modulus_MPa, find(result, kind, compliances[i - 1]).modulus_MPa);
    }
  }
}

// Sharp waves (grain angle up to 17 degrees): refining the elements settles the moduli.
TEST(Refinement, SettlesTheModuliOfAnUndulatedLaminate) {
  const auto panel = undulated_laminate(4, 25, 0.25, 5);
  auto options = options_with({0, 0.0163});
  std::vector<Result> results;
  for (const int elements : {3, 6, 12}) {
    options.elements_through_strand = elements;
    results.push_back(measure(panel, options));
  }
  expect_same("undulated laminate, 3 against 6 elements", results[0], results[1], below(0.03));
  expect_same("undulated laminate, 6 against 12 elements", results[1], results[2], below(0.01));
}

}  // namespace
}  // namespace strandlab::vtest
