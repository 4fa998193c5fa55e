#include "strandlab/report/estimates.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace strandlab::report {

files::CsvTable estimate_table(const std::vector<theory::Estimate>& estimates) {
  files::CsvTable table(
      {"model", "compaction", "density_kg_m3", "compliance_t_mm_per_MPa", "strand_length_mm", "gap_mm", "modulus_MPa"});
  for (const auto& e : estimates)
    table.add_row({e.model, e.compaction, e.density_kg_m3,
                   e.compliance_t ? files::CsvCell(*e.compliance_t) : files::CsvCell(std::string()), e.length_mm,
                   e.gap_mm, e.modulus_MPa});
  return table;
}

std::string text_of(const theory::Question& q, const std::vector<theory::Estimate>& estimates) {
  auto text = fmt::format("{:<30}{:>6}{:>14}{:>14}{:>12}{:>9}{:>14}\n", "model", "C", "density kg/m3", "1/D_t mm/MPa",
                          "length mm", "gap mm", "modulus MPa");
  for (const auto& e : estimates)
    text +=
        fmt::format("{:<30}{:>6.3g}{:>14.0f}{:>14}{:>12g}{:>9g}{:>14.0f}\n", e.model, e.compaction, e.density_kg_m3,
                    e.compliance_t ? fmt::format("{:g}", *e.compliance_t) : "", e.length_mm, e.gap_mm, e.modulus_MPa);
  const auto core = std::find_if_not(q.rows.begin(), q.rows.end(), theory::runs_along);
  if (core != q.rows.end())
    text += fmt::format(
        "random core of {}: quasi-isotropic laminate {:.0f}, mean over angles {:.0f}, the same in plane strain {:.0f} "
        "MPa\n",
        core->material.name, theory::quasi_isotropic_modulus_MPa(core->material),
        theory::off_axis_average_MPa(core->material), theory::plane_strain_average_MPa(core->material));
  for (const auto& model : theory::models()) {
    const bool used =
        std::any_of(estimates.begin(), estimates.end(), [&](const auto& e) { return e.model == model.name; });
    if (used) text += fmt::format("{}: {}\n", model.name, model.validity);
  }
  return text;
}

}  // namespace strandlab::report
