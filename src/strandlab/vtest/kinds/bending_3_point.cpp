// Bending on supports with the load P at midspan: apparent E = P S^3/(48 I w); without shear from the spans S and S/2
// (EN 408, variable span).
#include "strandlab/vtest/beam.hpp"
#include "strandlab/vtest/kinds/test.hpp"

namespace strandlab::vtest {
namespace {

// Modulus without shear from apparent ones at two spans: 1/E_app = 1/E + const/S^2.
double modulus_without_shear(double long_span, double long_modulus, double short_span, double short_modulus) {
  const double l = long_span * long_span, s = short_span * short_span;
  return (l - s) / (l / long_modulus - s / short_modulus);
}

Setup set_up_3_point(const Model& model, const Options& options) {
  const double span = span_mm(model, options), pad = pad_mm(model, options);
  const auto loaded_at = [&](double S) {
    auto test = supported(model, S, 0.5 * S, pad);
    add_load(model, 0, pad, 1, test);
    return test;
  };
  const auto whole = loaded_at(span), half = loaded_at(0.5 * span);
  return {{force_load(whole), deflection_load(whole), force_load(half), deflection_load(half)},
          [&model, whole, half](const Solutions& s) {
            Modulus modulus{TestKind::kBending3Point};
            apparent(model, whole, *s[0], *s[1], modulus);
            Modulus shorter{TestKind::kBending3Point};
            apparent(model, half, *s[2], *s[3], shorter);
            modulus.shear_free_modulus_MPa =
                modulus_without_shear(whole.span, modulus.modulus_MPa, half.span, shorter.modulus_MPa);
            return modulus;
          }};
}

}  // namespace

template <>
const VirtualTest& test<TestKind::kBending3Point>() {
  static constexpr VirtualTest kTest{.name = "bending_3_point",
                                     .label = "Bending (3 points)",
                                     .closed_form = ClosedForm::kLaminatedBeam,
                                     .supports = rigid_motion_supports,
                                     .set_up = set_up_3_point,
                                     .check_panel = check_span,
                                     .needed_length_mm = length_for_span_mm,
                                     .in_one_piece = true};
  return kTest;
}

}  // namespace strandlab::vtest
