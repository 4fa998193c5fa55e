// A case as the closed-form models see it.
#pragma once

#include <vector>

#include "strandlab/case/case.hpp"
#include "strandlab/theory/estimate.hpp"
#include "strandlab/theory/models.hpp"

namespace strandlab::run {

// Rows bottom to top with material, thickness, grain angles and strand statistics: those of the case's layup, or, for a
// case with a mat file, of `mat`, which was read from it: the mean strand length of each of its rows, the gap that
// gives the row's solid fraction, and material and angle of each strand. Throws as cases::layup().
std::vector<theory::Row> theory_rows(const cases::Case& c, const mat::Mat& mat);

// A question with the rows of a case, and its compactions and glues where the lists are empty. Throws as
// cases::make_mat() and settle_states().
theory::Question theory_question(cases::Case c, theory::Question question, std::vector<double> compactions,
                                 std::vector<double> compliances_t);

}  // namespace strandlab::run
