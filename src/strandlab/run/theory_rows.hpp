// A case as the closed-form models see it.
#pragma once

#include <vector>

#include "strandlab/case/case.hpp"
#include "strandlab/theory/models.hpp"

namespace strandlab::run {

// Rows bottom to top with material, thickness, grain angles and strand statistics: those of the case's layup, or, for a
// case with a mat file, of `mat`, which was read from it: the mean strand length of each of its rows, the gap that
// gives the row's solid fraction, and material and angle of each strand. Throws as cases::layup().
std::vector<theory::Row> theory_rows(const cases::Case& c, const mat::Mat& mat);

}  // namespace strandlab::run
