// Random sequential addition of one layer's strands.
#pragma once

#include <vector>

#include "strandlab/core/random.hpp"
#include "strandlab/mat/strand_source.hpp"

namespace strandlab::mat {

struct RandomLayer {
  std::vector<PlateStrand> strands;  // as placed
  DrawnAngles drawn;
};

// Strands of the row in a window that repeats in x and y. Size, angle and centre are drawn, the centre uniformly in the
// window; a strand that comes nearer than in_layer_gap_mm to another, to an image of one, or to its own is not placed.
// Which places are then open depends on the angle: placed strands are better aligned than drawn ones, unless
// keep_angle. Needs a row that check() accepts. Feder, Random sequential adsorption, J. theor. Biol. 87 (1980) 237-254.
RandomLayer sequential_layer(const PlateRow& row, const Window& torus, const SequentialOptions& options,
                             RandomStream random);

}  // namespace strandlab::mat
