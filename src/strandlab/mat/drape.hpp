// How the strands of a draped mat lie: each on all that were laid before it, bent down to them as far as its slopes
// allow.
#pragma once

#include <cstddef>
#include <vector>

#include "strandlab/mat/plate.hpp"

namespace strandlab::mat {

// Heights (mm, above the floor) of a strand's lower face at the corners of its own lattice; its upper face lies one
// thickness above.
struct DrapedStrand {
  std::size_t along = 1, across = 1;  // cells of the lattice
  std::vector<double> lower_mm;  // (along + 1)(across + 1) corners, from the strand's end at -length/2, along fastest

  double at(std::size_t i, std::size_t j) const { return lower_mm[i + j * (along + 1)]; }
};

struct Drape {
  std::vector<std::vector<DrapedStrand>> layers;  // as the mat's strands
  double mean_top_mm = 0, highest_mm = 0;         // of the upper surface of the mat, the floor where no strand lies
  double touching = 0;  // part of all lower faces that lies on a strand or the floor, to a hundredth of a thickness
};

// The lower face of a strand is the lowest surface z that is not below S, the top of all strands before it over its
// outline (0 where there is none), and whose slope is at most drape_slopes[0] along and [1] across the strand:
//   z(p) = max over q of S(q) - slope_along |u_p - u_q| - slope_across |v_p - v_q|, u and v along and across.
// That is a passage forward and one backward along each axis of the lattice. S is kept on a raster of half a lattice
// cell, of the window, and read bilinearly. Cells of the lattices are as near to cell_mm as fit a strand whole. Needs a
// valid draped mat. The same bits on every machine.
Drape drape(const PlateMat& mat, const std::vector<RoleAngle>& roles, double cell_mm);

}  // namespace strandlab::mat
