// Seconds and memory of the plate stiffness per 1/D_t on a periodic panel (tests/data/mats3d/per_a.json, and with
// "large" as long the demo's size: six layers on a window of 60 mm), elements 2 and 1 mm long, two through a strand, on
// one thread.
#include <fmt/format.h>
#include <sys/resource.h>

#include <cstring>

#include "strandlab/vtest/plate.hpp"

namespace {

double peak_GB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1e-6 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace strandlab;
  const std::string name = argc > 1 ? argv[1] : "per_a";
  const double element = argc > 2 ? std::stod(argv[2]) : 2;
  const wood::Material poplar;
  const std::vector<StrandKind> kinds{{"surface", poplar, 0}, {"core", poplar, 90}};
  const auto panel = make_panel(
      mat::read_plate(std::string(STRANDLAB_TEST_DATA "/mats3d/") + name + ".json", {{"surface", 0}, {"core", 90}}),
      kinds, 1, 2);
  vtest::PlateOptions options;
  options.element_length_mm = element;
  options.compliance_t_mm_per_MPa = {0, 0.0105, 0.05};
  options.glued_plates = false;
  if (argc > 3) options.perfect_bond = std::stod(argv[3]);
  const auto size = vtest::size_of_tests(panel, options);
  fmt::print("{}: {} unknowns, about {:.2f} GB\n", name, size.unknowns, size.memory_GB);
  const auto r = vtest::measure(panel, options);
  fmt::print("glued {:.3f} mm2, floating {} of {}\n", r.glued_area_mm2, r.floating_strands, r.strands);
  for (const auto& m : r.moduli)
    fmt::print("{:8} {:16} {:12.5f} {:12.5f}\n", m.compliance_t_mm_per_MPa, m.test, m.modulus_MPa,
               m.reaction_modulus_MPa);
  fmt::print("assemble {:.2f} analyse {:.2f} factor {:.2f} solve {:.2f} s; peak {:.2f} GB\n", r.assemble_s, r.analyse_s,
             r.factor_s, r.solve_s, peak_GB());
}
