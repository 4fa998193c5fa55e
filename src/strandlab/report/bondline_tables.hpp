// What `strandlab bondline` found out, as tables (one for specimens, one for groups, one for comparisons between
// groups) and as text.
#pragma once

#include <string>
#include <vector>

#include "strandlab/bondline/analysis.hpp"
#include "strandlab/files/csv.hpp"

namespace strandlab::report {

files::CsvTable specimen_table(const bondline::Analysis& analysis);
files::CsvTable group_table(const bondline::Analysis& analysis);
files::CsvTable comparison_table(const bondline::Analysis& analysis);

// For people: what was left out, the groups, how they compare.
std::string text_of(const bondline::Analysis& analysis);

// Which overlap measures a glue line best.
struct OverlapDesign {
  bondline::Geometry geometry;
  bondline::Uncertainty uncertainty;
  bondline::Formula formula = bondline::Formula::kCoth;
  std::vector<double> compliances_t{0.0021, 0.01048, 0.01628, 0.06536, 0.14645};  // 1/D_t, mm/MPa
  double shortest_mm = 2, longest_mm = 100;                                       // overlaps to choose from
};
// One line per compliance. Throws InputError for a specimen that cannot be.
std::string text_of(const OverlapDesign& design);

}  // namespace strandlab::report
