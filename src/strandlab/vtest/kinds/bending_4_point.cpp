// Bending on supports with P/2 at the thirds of the span: apparent E = 23 P S^3/(1296 I w); without shear from the
// deflection w_l over a length l between the loads, which bends without shear: E = P S l^2/(48 I w_l).
#include "strandlab/vtest/beam.hpp"
#include "strandlab/vtest/kinds/test.hpp"

namespace strandlab::vtest {
namespace {

Setup set_up_4_point(const Model& model, const Options& options) {
  const double span = span_mm(model, options), pad = pad_mm(model, options);
  auto test = supported(model, span, span / 3, pad);
  for (const double side : {-1.0, 1.0}) add_load(model, side * 0.5 * (span / 3), pad, 0.5, test);
  const double gauge_length = span / 3 - 2 * model.section.thickness;  // a thickness clear of the loads
  const statics::LoadCase gauge{sag(model, gauge_length), nothing(model)};
  return {{force_load(test), deflection_load(test), gauge}, [&model, test, gauge_length](const Solutions& s) {
            Modulus modulus{TestKind::kBending4Point};
            apparent(model, test, *s[0], *s[1], modulus);
            const double w = mutual_energy(model.bonded, *s[0], *s[2]);
            modulus.shear_free_modulus_MPa =
                test.arm * gauge_length * gauge_length / (16 * model.section.second_moment() * w);
            return modulus;
          }};
}

}  // namespace

template <>
const VirtualTest& test<TestKind::kBending4Point>() {
  static constexpr VirtualTest kTest{.name = "bending_4_point",
                                     .label = "Bending (4 points)",
                                     .closed_form = ClosedForm::kLaminatedBeam,
                                     .supports = rigid_motion_supports,
                                     .set_up = set_up_4_point,
                                     .check_panel = check_span,
                                     .needed_length_mm = length_for_span_mm,
                                     .in_one_piece = true};
  return kTest;
}

}  // namespace strandlab::vtest
