// Three- and four-point bending of beams whose moduli are known in closed form: Timoshenko's beam and laminated-beam
// theory, with the moduli of plane strain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "strandlab/mat/form.hpp"
#include "strandlab/theory/models.hpp"
#include "support/report.hpp"
#include "verification/vtest/reference_panels.hpp"

namespace strandlab::vtest {
namespace {

wood::Material isotropic(double E, double nu) {
  wood::Material m;
  m.E_L = m.E_R = m.E_T = E;
  m.G_RL = m.G_TL = m.G_RT = E / (2 * (1 + nu));
  m.nu_RL = m.nu_TL = m.nu_TR = nu;
  return m;
}

// Rows of strands as long as the panel, 0.8 mm each, at these angles.
Panel<2> full_rows(const wood::Material& material, const std::vector<double>& angles, double length_mm) {
  mat::Mat mat;
  mat.length_mm = length_mm;
  mat.layer_thickness_mm = 0.8;
  std::vector<StrandKind> kinds;
  for (const double angle : angles) {
    mat::Layer layer;
    layer.role = std::to_string(angle);
    layer.strands.emplace_back().x1_mm = length_mm;
    mat.layers.push_back(layer);
    kinds.push_back({layer.role, material, angle});
  }
  return make_panel(mat, kinds, 0.4, 6);
}

// Random OSB mat of eight rows in a window of 150 mm.
mat::Mat osb() {
  mat::Layup layup{150, 0.8, {}};
  for (int i = 0; i < 8; ++i)
    layup.rows.push_back(i < 2 || i > 5 ? mat::LayupRow{"surface", {60, 8, 6, 2}}
                                        : mat::LayupRow{"core", {25, 3, 4, 1}});
  return mat::form(layup, 5);
}

Options on_supports() {
  Options options;
  options.kinds = {TestKind::kBending3Point, TestKind::kBending4Point};
  return options;
}

// 1/E_app = 1/E + c/(5/6 G) (h/S)^2 with c = 1 for three points and 2 S^2/(3 S^2 - 4 a^2) = 18/23 for loads at thirds
// (Timoshenko's beam of rectangular section).
double timoshenko(double E, double G, double c, double span_to_thickness) {
  return 1 / (1 / E + c / (5.0 / 6 * G) / (span_to_thickness * span_to_thickness));
}

// limit3 and limit4: of the shear-free moduli, in per cent.
void expect_timoshenko(const std::string& what, const wood::Material& material, double E, double G, double limit3,
                       double limit4) {
  auto options = on_supports();
  for (const double ratio : {20.0, 24.0}) {
    options.span_to_thickness = ratio;
    const auto result = measure(full_rows(material, {0, 0, 0, 0}, 3.2 * (ratio + 2)), options);
    const double error3 = result.moduli[0].modulus_MPa / timoshenko(E, G, 1, ratio) - 1;
    const double error4 = result.moduli[1].modulus_MPa / timoshenko(E, G, 18.0 / 23, ratio) - 1;
    const double true3 = *result.moduli[0].shear_free_modulus_MPa / E - 1;
    const double true4 = *result.moduli[1].shear_free_modulus_MPa / E - 1;
    const auto at = ", span " + std::to_string(static_cast<int>(ratio)) + " thicknesses";
    report(what + ", 3-point" + at + ": apparent modulus against Timoshenko", 100 * error3, within(0.5), "%");
    report(what + ", 4-point" + at + ": apparent modulus against Timoshenko", 100 * error4, within(0.4), "%");
    report(what + ", 3-point" + at + ": shear-free against plane-strain modulus", 100 * true3, within(limit3), "%");
    report(what + ", 4-point" + at + ": shear-free against plane-strain modulus", 100 * true4, within(limit4), "%");
    for (const auto& m : result.moduli) EXPECT_NEAR(m.reaction_modulus_MPa / m.modulus_MPa, 1, 1e-6) << what << at;
  }
}

TEST(BendingOnSupports, IsotropicBeamIsTimoshenkos) {
  const double E = 2500, nu = 0.33;
  expect_timoshenko("isotropic", isotropic(E, nu), E / (1 - nu * nu), E / (2 * (1 + nu)), 0.02, 1.5e-5);
}

TEST(BendingOnSupports, WoodenBeamIsTimoshenkos) {
  expect_timoshenko("poplar", wood::Material{}, theory::plane_strain_modulus_MPa({}, 0), wood::Material{}.G_RL, 0.15,
                    0.01);
}

// Seven plies, grain of every other one across: sum of E_i I_i over I with the plies' plane-strain moduli.
TEST(BendingOnSupports, PlywoodBeamIsTheLaminate) {
  const std::vector<double> angles{0, 90, 0, 90, 0, 90, 0};
  std::vector<double> moduli;
  for (const double angle : angles) moduli.push_back(theory::plane_strain_modulus_MPa({}, angle));
  const double laminate = theory::bending_of_moduli_MPa(moduli, 0);
  const auto result = measure(full_rows({}, angles, 5.6 * 22), on_supports());
  const double error = *result.moduli[1].shear_free_modulus_MPa / laminate - 1;
  report("plywood, 4-point: shear-free modulus against laminated-beam theory", 100 * error, within(0.2), "%");
  // Rolling shear in the cross plies makes the shear deflection large: the apparent moduli lie well below.
  for (const auto& m : result.moduli) EXPECT_LT(m.modulus_MPa, 0.95 * laminate);
  EXPECT_NEAR(*result.moduli[0].shear_free_modulus_MPa / laminate, 1, 0.02);
}

// The pads' width spreads forces over places only; from a quarter to one thickness it moves a modulus by next to
// nothing.
TEST(BendingOnSupports, WidthOfThePadsDoesNotMatter) {
  auto options = on_supports();
  const auto beam = full_rows({}, {0, 0, 0, 0}, 3.2 * 22);
  const auto usual = measure(beam, options);
  double worst = 0;
  for (const double width : {0.25, 1.0}) {
    options.pad_to_thickness = width;
    const auto other = measure(beam, options);
    for (std::size_t i = 0; i < 2; ++i) {
      worst = std::max(worst, std::abs(other.moduli[i].modulus_MPa / usual.moduli[i].modulus_MPa - 1));
      worst = std::max(worst,
                       std::abs(*other.moduli[i].shear_free_modulus_MPa / *usual.moduli[i].shear_free_modulus_MPa - 1));
    }
  }
  report("pads of a quarter and a whole thickness against half: largest change of a modulus", 100 * worst, below(0.2),
         "%");
}

TEST(BendingOnSupports, ConvergesWithTheElements) {
  auto options = on_supports();
  options.elements_through_strand = 6;
  const auto beam = full_rows({}, {0, 90, 0, 90}, 3.2 * 22);
  const auto fine = measure(beam, options);
  double before = 1;
  for (const int elements : {1, 2, 3}) {
    options.elements_through_strand = elements;
    const auto coarse = measure(beam, options);
    double worst = 0;
    for (std::size_t i = 0; i < 2; ++i)
      worst = std::max(worst, std::abs(coarse.moduli[i].modulus_MPa / fine.moduli[i].modulus_MPa - 1));
    report(std::to_string(elements) + " elements through a strand against 6: largest change of an apparent modulus",
           100 * worst,
           below(elements == 1   ? 0.4
                 : elements == 2 ? 0.1
                                 : 0.04),
           "%");
    EXPECT_LT(worst, before) << elements;
    before = worst;
  }
}

// Turned end for end, a panel is as stiff as before.
TEST(BendingOnSupports, MirroredPanelIsAsStiff) {
  auto mat = osb();
  auto options = on_supports();
  options.compliance_t_mm_per_MPa = {0, 0.0163};
  const auto one = measure(panel_of(mat, 0.4), options);
  for (auto& layer : mat.layers) {
    for (auto& strand : layer.strands) {
      const double x0 = mat.length_mm - strand.x1_mm;
      strand.x1_mm = mat.length_mm - strand.x0_mm;
      strand.x0_mm = x0;
    }
    std::reverse(layer.strands.begin(), layer.strands.end());
  }
  const auto other = measure(panel_of(mat, 0.4), options);
  double worst = 0;
  for (std::size_t i = 0; i < one.moduli.size(); ++i) {
    worst = std::max(worst, std::abs(other.moduli[i].modulus_MPa / one.moduli[i].modulus_MPa - 1));
    worst =
        std::max(worst, std::abs(*other.moduli[i].shear_free_modulus_MPa / *one.moduli[i].shear_free_modulus_MPa - 1));
  }
  report("mirrored panel: largest change of a modulus", worst, below(2e-7));
}

// Softer glue lets strands slide: every modulus falls, and the energies agree with the deflections.
TEST(BendingOnSupports, SofterGlueBendsMore) {
  auto options = on_supports();
  options.compliance_t_mm_per_MPa = {0, 0.0021, 0.0163, 0.05};
  const auto result = measure(flattened(panel_of(osb(), 0.4), 0.2), options);
  double reaction = 0;
  for (const auto& m : result.moduli)
    reaction = std::max(reaction, std::abs(m.reaction_modulus_MPa / m.modulus_MPa - 1));
  report("random panel: energy against deflection moduli", reaction, below(2e-7));
  for (std::size_t i = 2; i < result.moduli.size(); ++i) {
    EXPECT_LT(result.moduli[i].modulus_MPa, result.moduli[i - 2].modulus_MPa) << i;
    EXPECT_LT(*result.moduli[i].shear_free_modulus_MPa, *result.moduli[i - 2].shear_free_modulus_MPa) << i;
  }
}

}  // namespace
}  // namespace strandlab::vtest
