// Tables of the density of plates over their area.
#pragma once

#include <vector>

#include "strandlab/files/csv.hpp"
#include "strandlab/profile/horizontal.hpp"

namespace strandlab::report {

// Of a panel at one compaction.
struct HorizontalDensity {
  struct Zone {
    double size_mm = 0;
    double sd_over_mean = 0;
  };
  double compaction = 0;
  profile::DensityMap map;
  std::vector<Zone> zones;
  double void_fraction = 0;
};

// Map in cells of about a millimetre, zones of about 5, 10, 25.4 and 50 mm, whole cells of the map, as far as two fit
// the window.
HorizontalDensity horizontal_density(const Panel<3>& panel, double compaction);

// compaction, x_mm, y_mm (middle of a cell), density_kg_m3, voids included; one row per cell.
files::CsvTable density_map_table(const std::vector<HorizontalDensity>& densities);

// compaction, void_fraction, zone_mm, sd_over_mean; one row per size of zone.
files::CsvTable horizontal_density_table(const std::vector<HorizontalDensity>& densities);

}  // namespace strandlab::report
