#include "strandlab/report/result_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace strandlab::report {

files::CsvTable press_table(const std::vector<press::Record>& records) {
  const bool hot = std::any_of(records.begin(), records.end(),
                               [](const auto& r) { return r.softening_mJ != 0 || r.damping_mJ != 0; });
  std::vector<std::string> columns{"compaction",     "time_ms",     "stress_MPa",  "force_top_N",
                                   "force_bottom_N", "kinetic_mJ",  "internal_mJ", "plastic_mJ",
                                   "elastic_mJ",     "friction_mJ", "contact_mJ",  "filter_mJ"};
  if (hot) columns.insert(columns.end(), {"softening_mJ", "damping_mJ"});
  columns.emplace_back("platen_work_mJ");
  files::CsvTable table(columns);
  for (const auto& r : records) {
    std::vector<files::CsvCell> row{r.compaction,     r.time_ms,     r.stress_MPa,    r.force_top_N,
                                    r.force_bottom_N, r.kinetic_mJ,  r.internal_mJ(), r.plastic_mJ,
                                    r.elastic_mJ,     r.friction_mJ, r.contact_mJ,    r.filter_mJ};
    if (hot) row.insert(row.end(), {r.softening_mJ, r.damping_mJ});
    row.emplace_back(r.platen_work_mJ);
    table.add_row(row);
  }
  return table;
}

files::CsvTable moduli_table(const std::vector<PanelModulus>& moduli) {
  files::CsvTable table({"compaction", "test", "compliance_t_mm_per_MPa", "modulus_MPa", "reaction_modulus_MPa",
                         "shear_free_modulus_MPa", "density_kg_m3"});
  for (const auto& m : moduli) {
    table.add_row({m.compaction, m.test, m.compliance_t_mm_per_MPa, m.modulus_MPa, m.reaction_modulus_MPa,
                   m.shear_free_modulus_MPa.value_or(std::nan("")), m.density_kg_m3});
  }
  return table;
}

files::CsvTable plate_table(const std::vector<PlateState>& states) {
  std::vector<std::string> columns{"compaction", "compliance_t_mm_per_MPa"};
  for (int i = 1; i <= 6; ++i) {
    for (int j = 1; j <= 6; ++j) columns.push_back(fmt::format("ABD_{}{}", i, j));
  }
  files::CsvTable table(columns);
  for (const auto& state : states) {
    for (const auto& tensor : state.result.tensors) {
      std::vector<files::CsvCell> row{state.compaction, tensor.compliance_t_mm_per_MPa};
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) row.emplace_back(tensor.abd(i, j));
      }
      table.add_row(std::move(row));
    }
  }
  return table;
}

files::CsvTable slip_table(const vtest::Result& result) {
  files::CsvTable table({"compliance_t_mm_per_MPa", "strand_a", "strand_b", "x_mm", "y_mm", "slip_mm_per_strain"});
  const auto rounded = [](double mm) { return std::round(1e4 * mm) / 1e4 + 0.0; };  // + 0: no -0
  for (const auto& s : result.slips) {
    table.add_row({result.slip_compliance_t_mm_per_MPa, static_cast<long long>(s.a), static_cast<long long>(s.b),
                   rounded(s.position[0]), rounded(s.position[1]), rounded(s.slip_mm_per_strain)});
  }
  return table;
}

}  // namespace strandlab::report
