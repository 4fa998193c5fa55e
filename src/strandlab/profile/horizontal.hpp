// Density of a plate over its area (horizontal density distribution).
#pragma once

#include <vector>

#include "strandlab/panel/panel.hpp"

namespace strandlab::profile {

// Density of the columns over a raster of equal cells, kg/m^3, voids included.
struct DensityMap {
  int along = 0, across = 0;  // cells along x and y
  double cell_x_mm = 0, cell_y_mm = 0;
  bool periodic = false;
  std::vector<double> kg_m3;  // along x first
  double at(int i, int j) const {
    return kg_m3[static_cast<std::size_t>(j) * static_cast<std::size_t>(along) + static_cast<std::size_t>(i)];
  }
};

// The map of a panel as it lies between the platens, in cells as near to cell_mm as fit the window. The domain of every
// material point seen from above, the parallelogram x +- F spacing/2 of its edges along and across the strand, is cut
// exactly by the raster's lines; beyond an edge of a periodic window it comes in at the other one, beyond another edge
// it counts in the cell there. Throws InputError for a panel without thickness and for a cell that is not positive.
DensityMap density_map(const Panel<3>& panel, double cell_mm);

// Standard deviation over mean of the density of square zones of so many cells, at all their places: on a periodic
// window over its edges too. Throws InputError for zones larger than the map.
double variation(const DensityMap& map, int zone_cells);

// Part of the panel's volume between the platens that no wood fills.
double void_fraction(const Panel<3>& panel);

// Strands laid at random, all alike, along x or y: variance of their mean number over zones of zone_mm over that number
// (Dai & Steiner 1994). For strands at other angles it is hardly different.
double poisson_variance(double zone_mm, double length_mm, double width_mm);

}  // namespace strandlab::profile
