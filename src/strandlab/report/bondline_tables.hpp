// The tables of `strandlab bondline`: one for specimens, one for groups, one for comparisons between groups.
#pragma once

#include "strandlab/bondline/analysis.hpp"
#include "strandlab/files/csv.hpp"

namespace strandlab::report {

files::CsvTable specimen_table(const bondline::Analysis& analysis);
files::CsvTable group_table(const bondline::Analysis& analysis);
files::CsvTable comparison_table(const bondline::Analysis& analysis);

}  // namespace strandlab::report
