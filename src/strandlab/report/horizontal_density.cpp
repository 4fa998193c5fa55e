#include "strandlab/report/horizontal_density.hpp"

#include <algorithm>
#include <cmath>

namespace strandlab::report {

HorizontalDensity horizontal_density(const Panel<3>& panel, double compaction) {
  constexpr double kCell = 1;  // mm
  HorizontalDensity density{compaction, profile::density_map(panel, kCell), {}, profile::void_fraction(panel)};
  const auto& map = density.map;
  for (const double size : {5.0, 10.0, 25.4, 50.0}) {
    const int cells = std::max(1, static_cast<int>(std::lround(size / map.cell_x_mm)));
    if (2 * cells > std::min(map.along, map.across)) break;
    density.zones.push_back({cells * map.cell_x_mm, profile::variation(map, cells)});
  }
  return density;
}

files::CsvTable density_map_table(const std::vector<HorizontalDensity>& densities) {
  files::CsvTable table({"compaction", "x_mm", "y_mm", "density_kg_m3"});
  const auto rounded = [](double value) { return std::round(1e4 * value) / 1e4; };
  for (const auto& density : densities) {
    const auto& map = density.map;
    for (int j = 0; j < map.across; ++j) {
      for (int i = 0; i < map.along; ++i)
        table.add_row({density.compaction, rounded((i + 0.5) * map.cell_x_mm), rounded((j + 0.5) * map.cell_y_mm),
                       rounded(map.at(i, j))});
    }
  }
  return table;
}

files::CsvTable horizontal_density_table(const std::vector<HorizontalDensity>& densities) {
  files::CsvTable table({"compaction", "void_fraction", "zone_mm", "sd_over_mean"});
  for (const auto& density : densities) {
    for (const auto& zone : density.zones)
      table.add_row({density.compaction, density.void_fraction, zone.size_mm, zone.sd_over_mean});
  }
  return table;
}

}  // namespace strandlab::report
