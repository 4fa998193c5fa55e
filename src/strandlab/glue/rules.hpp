// What decides whether two faces may be glued, in sections and panels alike.
#pragma once

#include <algorithm>

#include "strandlab/glue/glue.hpp"

namespace strandlab::glue {

// Faces look at each other where their outward normals are more than 120 degrees apart. Judgement: those of flat
// strands are 180 degrees apart; it keeps the faces of a strand end that the press folded over from bonding to what
// they slid along.
inline constexpr double kFaceToFace = -0.5;  // cosine

// How far two strands in contact may overlap, mm: half of the thinner one. Judgement; contact on the grid lets them
// overlap by a part of a cell.
inline double overlap_in_contact(double thickness_a, double thickness_b) {
  return 0.5 * std::min(thickness_a, thickness_b);
}

// Throws InputError for a gap that is not positive, a negative spacing or a coverage that cannot be.
void check(const CuringOptions& options);

}  // namespace strandlab::glue
