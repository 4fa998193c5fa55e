#pragma once

#include "strandlab/wood/material.hpp"
#include "strandlab/wood/return_map.hpp"

namespace strandlab::wood {

// Position of the return map's component k (11, 22, 33, 13, 23, 12) in Voigt order.
inline constexpr int kModeToVoigt[6] = {0, 1, 2, 4, 3, 5};

// Simultaneous diagonalisation of elastic energy and yield surface. N = 4 needs a strand whose grain lies along or
// across the section (no coupling to the 23 and 12 shears); see needs_six().
template <int N>
YieldModes<N> yield_modes(const StrandMaterial& material);

// Whether the strand couples in-plane and out-of-plane shears (angle neither 0 nor 90 degrees).
bool needs_six(const StrandMaterial& material);

}  // namespace strandlab::wood
