// Which strands of a plate carry load all the way across it.
#pragma once

#include <vector>

#include "strandlab/glue/glue.hpp"

namespace strandlab::vtest {

struct PlateConnection {
  std::vector<bool> kept;  // by strand: it belongs to the largest piece (by wood) that glue holds together
  int floating = 0;        // strands that do not
  // Periodic: whether that piece is connected to its images along x and along y, by glue from strand to strand around
  // the torus, and to both independently; cut: whether it reaches both ends along x and along y.
  bool across_x = false, across_y = false, across_both = false;
};

// A strand whose glue points leave it free to turn (one point, or all on a line) is held by nothing: it floats.
PlateConnection connect(const Panel<3>& panel, const std::vector<glue::GluePoint<3>>& points);

}  // namespace strandlab::vtest
