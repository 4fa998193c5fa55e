// The tables of `strandlab bondline`: one for specimens, one for groups, one for comparisons between groups.
#pragma once

#include "strandlab/bondline/analysis.hpp"
#include "strandlab/io/csv.hpp"

namespace strandlab::app {

io::CsvTable specimen_table(const bondline::Analysis& analysis);
io::CsvTable group_table(const bondline::Analysis& analysis);
io::CsvTable comparison_table(const bondline::Analysis& analysis);

}  // namespace strandlab::app
