// A panel on a coarser lattice: what a picture needs of it, at a fraction of its size.
#pragma once

#include "strandlab/panel/panel.hpp"

namespace strandlab {

// The panel with at most `points_through` points through each strand and points about `spacing_along_mm` long (as
// formed) along it, never more than it has. Strand outlines are those of the fine corner lattice at the coarse corners;
// a coarse point's deformation gradient is that of its corners, so that its area, density and grain angle are what the
// picture shows; its stress and plastic strain are means over the fine points it covers. Velocities are zero. Throws
// std::invalid_argument unless both numbers are positive.
Panel<2> lumped(const Panel<2>& panel, double spacing_along_mm, int points_through);

}  // namespace strandlab
