// What a user may choose of the strands of a random mat.
#pragma once

#include <vector>

#include "strandlab/core/declaration.hpp"
#include "strandlab/mat/form.hpp"
#include "strandlab/mat/plate_layup.hpp"

namespace strandlab::mat {

std::vector<Declaration<StrandStatistics>> statistics_options();
// The same of a plate's: forming and its window, and the sizes of whole strands.
std::vector<Declaration<PlateLayup>> plate_options();
std::vector<Declaration<SizeStatistics>> size_options();

}  // namespace strandlab::mat
