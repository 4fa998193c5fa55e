#include "strandlab/run/profile_bins.hpp"

#include <algorithm>
#include <cmath>

#include "strandlab/press/press.hpp"

namespace strandlab::run {

int bins_of_one_cell(const cases::Case& c, const Panel<2>& panel, double compaction) {
  const double cell = press::setup(panel, c.grid, c.sides, c.mpm).grid.cell[1];  // as formed
  const double thickness = panel.initial_thickness_mm * (c.grid.follow_platens ? 1 : 1 - compaction);
  return std::max(1, static_cast<int>(std::lround(thickness / cell)));
}

}  // namespace strandlab::run
