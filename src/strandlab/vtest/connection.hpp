// Which strands carry load from one end of a panel to the other.
#pragma once

#include <vector>

#include "strandlab/glue/glue.hpp"

namespace strandlab::vtest {

// Groups of strands held together by glue. Only groups that reach both loaded ends are kept.
struct Connection {
  std::vector<bool> at_left, at_right;  // by strand: its end lies on the end plane x = 0, x = length
  std::vector<int> group;               // by strand: number of its kept group, -1 for a strand that floats
  int groups = 0;
  int floating = 0;  // strands
};

Connection connect(const Panel<2>& panel, const std::vector<glue::GluePoint<2>>& points);

}  // namespace strandlab::vtest
