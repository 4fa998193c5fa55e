// Seconds of a virtual test per 1/D_t on a whole OSB mat: tension and end rotation, 3 and 6 elements through a strand.
#include <fmt/format.h>

#include "strandlab/vtest/vtest.hpp"

int main() {
  using namespace strandlab;
  const wood::Material poplar;
  const auto panel = make_panel(mat::read(STRANDLAB_TEST_DATA "/reference/osb_s1.json", {"surface", "core"}),
                                {{"surface", poplar, 0}, {"core", poplar, 90}}, 0.8 / 6, 6);
  vtest::Options options;
  options.compliance_t_mm_per_MPa = {0, 0.0021, 0.0105, 0.0163, 0.05};
  const double n = static_cast<double>(options.compliance_t_mm_per_MPa.size());
  for (const int elements : {3, 6}) {
    options.elements_through_strand = elements;
    const auto r = vtest::measure(panel, options);
    fmt::print(
        "{} elements, {} unknowns: assemble {:.3f} s, analyse {:.3f} s, factor {:.3f} s, solve {:.3f} s; {:.3f} s per "
        "1/D_t\n",
        elements, r.unknowns, r.assemble_s, r.analyse_s, r.factor_s, r.solve_s,
        (r.assemble_s + r.analyse_s + r.factor_s + r.solve_s) / n);
  }
}
