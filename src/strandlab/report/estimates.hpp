// Closed-form estimates of a panel as a table and as text.
#pragma once

#include <string>
#include <vector>

#include "strandlab/files/csv.hpp"
#include "strandlab/theory/estimate.hpp"

namespace strandlab::report {

// model, compaction, density_kg_m3, compliance_t_mm_per_MPa, strand_length_mm, gap_mm, modulus_MPa; one row per value.
files::CsvTable estimate_table(const std::vector<theory::Estimate>& estimates);

// The same for people, with what a random core would have and what each model holds for. The estimates answer the
// question.
std::string text_of(const theory::Question& question, const std::vector<theory::Estimate>& estimates);

}  // namespace strandlab::report
