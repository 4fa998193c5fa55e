// One row of a section mat before it is cut to the window: a stationary random sequence strand, gap, strand, gap...
#pragma once

#include <cstdint>
#include <vector>

#include "strandlab/core/random.hpp"
#include "strandlab/mat/form.hpp"

namespace strandlab::mat {

// Places in a row are whole numbers of 1e-6 mm, the resolution of a mat file: sums are exact and nothing is left to
// round.
using Ticks = std::int64_t;
inline constexpr double kTicksPerMm = 1e6;

struct RowStrand {
  Ticks x0, x1;
  double angle_deg = 0;  // of strands that are cut (cut.hpp)
};

// The row's strands from the cycle (a strand and the gap after it) that covers x = 0 up to and including the first
// strand that starts at or beyond `window`. Needs statistics that form() accepts, with length_mm > 0.
//
// The row is stationary: seen from a fixed point, the covering cycle is length-biased (density proportional to its own
// length) and the point lies uniformly in it (Cox, Renewal Theory, 1962, ch. 5). It is drawn so by rejection: a cycle
// of length S is kept with probability S/S_max. A strand then covers x = 0 with probability <L>/(<L> + <G>), and its
// length is length-biased.
// Angles only matter to strands with a width.
std::vector<RowStrand> stationary_row(const StrandStatistics& statistics, Ticks window, RandomStream& random,
                                      const AngleDistribution& angles = {});

}  // namespace strandlab::mat
