// Random deposition of strands, which may lie over each other.
#pragma once

#include "strandlab/mat/sequential.hpp"

namespace strandlab::mat {

// As many strands of the row in a window that repeats as cover it `mean_count` times, anywhere and at any of their
// angles: N = mean_count x window / mean area of a strand, rounded. The strands over a point are binomial, over a large
// window Poisson, with that mean. Fines are drawn among the others, by their number. Needs a row that check() accepts;
// throws InputError for a strand that meets its own image. Dai & Steiner, Wood Sci. Technol. 28 (1994) 135-146.
RandomLayer deposited_layer(const PlateRow& row, double mean_count, const Window& torus, RandomStream random);

}  // namespace strandlab::mat
