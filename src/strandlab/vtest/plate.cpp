#include "strandlab/vtest/plate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/core/stopwatch.hpp"
#include "strandlab/glue/bond.hpp"
#include "strandlab/vtest/plate_model.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::vtest {

void check(const Panel<3>& panel, const PlateOptions& options) {
  if (panel.strands.empty()) throw InputError("the panel has no strands to test");
  check_bonds_and_elements(options.compliance_t_mm_per_MPa, options.compliance_n_mm_per_MPa,
                           options.elements_through_strand);
  if (!(options.element_length_mm > 0) || !std::isfinite(options.element_length_mm)) {
    throw InputError(fmt::format("elements {} mm long: a positive length is needed", options.element_length_mm));
  }
}

PlateSize size_of_tests(const Panel<3>& panel, const PlateOptions& options) {
  PlateSize size;
  if (panel.strands.empty()) return size;
  const double thinnest = thinnest_strand(panel);
  for (const auto& strand : panel.strands) {
    const auto& lattice = strand.lattice;
    size.unknowns += 3L * (divisions(lattice.extent(0), options.element_length_mm) + 1) *
                     (divisions(lattice.extent(1), options.element_length_mm) + 1) *
                     (mat::through(lattice.thickness(), thinnest, options.elements_through_strand) + 1);
  }
  const auto n = static_cast<double>(size.unknowns);
  const int factors = !panel.periodic ? 3 : options.glued_plates ? 2 : 1;  // cut: of plane ends along x, y; of shear
  size.seconds_per_compliance = factors * 1.5 * std::pow(n / 42e3, 1.3);
  size.memory_GB = 1e-9 * (10 * 5.8e6 * std::pow(n / 19e3, 1.32) + 2500 * n);  // factor; matrices and elements
  return size;
}

PlateResult measure(const Panel<3>& panel, const PlateOptions& options, const std::function<void()>& before_solve) {
  check(panel, options);
  PlateResult result;
  auto model = make_plate_model(panel, options, result);
  statics::SolveTimes times;
  statics::PlateLoads loads;
  if (panel.periodic) {
    const Stopwatch watch(times.assemble);
    loads = statics::plate_loads(model.mesh, model.middle());
  }
  const Solver solver{times, before_solve};
  for (const double compliance_t : options.compliance_t_mm_per_MPa) {
    const glue::Bond bond{compliance_t, options.compliance_n_mm_per_MPa};
    for (const auto& remark : glue::remarks(bond)) {
      if (std::find(result.warnings.begin(), result.warnings.end(), remark) == result.warnings.end())
        result.warnings.push_back(remark);
    }
    model.bonded.glue(bond, times);
    const auto before = result.moduli.size();
    if (panel.periodic) {
      test_torus(model, loads, solver, result);
      result.tensors.back().compliance_t_mm_per_MPa = compliance_t;
      if (options.glued_plates) test_glued_plates(model, solver, result);
    } else {
      test_plane_ends(model, solver, result);
    }
    for (auto k = before; k < result.moduli.size(); ++k) result.moduli[k].compliance_t_mm_per_MPa = compliance_t;
  }
  result.assemble_s += times.assemble;
  result.analyse_s = times.analyse;
  result.factor_s = times.factor;
  result.solve_s = times.solve;
  return result;
}

}  // namespace strandlab::vtest
