#include "strandlab/mat/options.hpp"

#include "strandlab/mat/mat.hpp"

namespace strandlab::mat {

std::vector<Declaration<StrandStatistics>> statistics_options() {
  using S = StrandStatistics;
  const Range size_or_zero{.lo = kSmallestSize_mm, .hi = kLargestSize_mm, .zero = true};
  return {declare("length_mm", "mm", size_or_zero,
                  "mean length of a strand in the section; 0 with gap 0: one strand fills the row", &S::length_mm),
          declare("length_sd_mm", "mm", kNotNegative, "its standard deviation, at most the mean", &S::length_sd_mm),
          declare("gap_mm", "mm", {.lo = 0, .hi = kLargestSize_mm}, "mean gap between strands of a row", &S::gap_mm),
          declare("gap_sd_mm", "mm", kNotNegative, "its standard deviation, at most the mean", &S::gap_sd_mm)};
}

}  // namespace strandlab::mat
