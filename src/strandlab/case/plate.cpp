#include "strandlab/case/plate.hpp"

#include <fmt/format.h>

#include "strandlab/case/plate_mat.hpp"
#include "strandlab/core/error.hpp"

namespace strandlab::cases {
namespace {

std::string opening(const Case& c) {
  if (c.mat_file.empty()) return c.places.rows.empty() ? c.name : c.places.rows;
  return c.places.mat_file.empty() ? c.mat_file : fmt::format("{}: {}", c.places.mat_file, c.mat_file);
}

void refuse_pressing(const Case& c) {
  const auto& compactions = c.states.compactions;
  if (compactions.size() == 1 && compactions[0] == 0) return;
  throw InputError(fmt::format(
      "{}: pressing in 3D is not there yet: a plate's mat is tested as it lies, with press.compactions = [0] "
      "and no other states (press.densities_kg_m3, press.thicknesses_mm)",
      opening(c)));
}

// Of a message about the mat: where it is from.
template <class Make>
auto about_plate(const Case& c, const Make& make) {
  try {
    return make();
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", opening(c), e.what()));
  }
}

}  // namespace

bool has_plate_mat(const Case& c) {
  return is_plate(c) || (!c.mat_file.empty() && mat::dimensions(c.mat_file) == 3);
}

mat::PlateMat make_plate_mat(const Case& c) {
  refuse_pressing(c);
  return make_plate(c).mat;
}

Panel<3> make_panel(const Case& c, const mat::PlateMat& mat) {
  return about_plate(c, [&] {
    return strandlab::make_panel(mat, kinds_and_materials(c), c.test.element_length_mm, c.test.elements_through_strand);
  });
}

Weight weigh(const Case& c, const mat::PlateMat& mat) {
  return about_plate(c, [&] { return strandlab::weigh(mat, kinds_and_materials(c)); });
}

vtest::PlateOptions plate_options(const Case& c) {
  vtest::PlateOptions options;
  options.compliance_t_mm_per_MPa = c.test.compliance_t_mm_per_MPa;
  options.compliance_n_mm_per_MPa = c.test.compliance_n_mm_per_MPa;
  options.elements_through_strand = c.test.elements_through_strand;
  options.element_length_mm = c.test.element_length_mm;
  if (c.test.curing.coverage.spot_mm > 0)
    throw InputError("glue.spot_mm: spots of resin are laid on sections only; leave it at 0 for a mat in 3D");
  options.curing = c.test.curing;
  return options;
}

}  // namespace strandlab::cases
