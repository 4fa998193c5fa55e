// What a user may choose of the strands of a random mat.
#pragma once

#include <vector>

#include "strandlab/core/declaration.hpp"
#include "strandlab/mat/form.hpp"

namespace strandlab::mat {

std::vector<Declaration<StrandStatistics>> statistics_options();

}  // namespace strandlab::mat
