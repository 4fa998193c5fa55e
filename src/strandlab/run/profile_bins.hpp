// Bins of a density profile that are one cell of the pressing grid high.
#pragma once

#include "strandlab/case/case.hpp"

namespace strandlab::run {

// Number of cells between the platens when the panel has the compaction it was kept at: cells that follow the platens
// stay as many as at the start, others become fewer.
int bins_of_one_cell(const cases::Case& c, const Panel<2>& panel, double compaction);

}  // namespace strandlab::run
