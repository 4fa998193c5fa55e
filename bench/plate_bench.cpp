// Seconds and memory of a plate's stiffness per 1/D_t: a periodic mat of 48 strands (tests/data/mats3d/per_a_45.json),
// elements 2 and 1 mm long, two through a strand, on one thread.
#include <fmt/format.h>
#include <sys/resource.h>

#include "strandlab/vtest/plate.hpp"

namespace {

double peak_GB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1e-6 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace

int main() {
  using namespace strandlab;
  const wood::Material poplar;
  const auto mat = mat::read_plate(STRANDLAB_TEST_DATA "/mats3d/per_a_45.json", {{"surface", 0}, {"core", 90}});
  const auto panel = make_panel(mat, {{"surface", poplar, 0}, {"core", poplar, 90}}, 1, 2);
  vtest::PlateOptions options;
  options.compliance_t_mm_per_MPa = {0, 0.0105, 0.05};
  options.glued_plates = false;
  const double n = static_cast<double>(options.compliance_t_mm_per_MPa.size());
  for (const double element : {2.0, 1.0}) {
    options.element_length_mm = element;
    const auto size = vtest::size_of_tests(panel, options);
    const auto r = vtest::measure(panel, options);
    fmt::print(
        "{} mm, {} unknowns: assemble {:.2f} s, analyse {:.2f} s, factor {:.2f} s, solve {:.2f} s; {:.2f} s per 1/D_t; "
        "about {:.2f} GB expected, peak {:.2f} GB\n",
        element, r.unknowns, r.assemble_s, r.analyse_s, r.factor_s, r.solve_s,
        (r.assemble_s + r.analyse_s + r.factor_s + r.solve_s) / n, size.memory_GB, peak_GB());
  }
}
