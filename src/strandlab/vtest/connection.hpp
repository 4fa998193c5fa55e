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

// Whether glue could connect x = 0 with x = length once a mat between rollers is pressed to a compaction, or on the
// way. Generous: strands of any two rows may meet where they lie over one another in plan, each widened on both sides
// by the thickness of the mat and by what it gains in length when all the compaction is its own. Strands of one row
// keep their order and never bond; only the first and the last of a row can reach an end.
bool can_connect(const Panel<2>& mat, double compaction);

}  // namespace strandlab::vtest
