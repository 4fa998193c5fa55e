#include "strandlab/profile/horizontal.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/core/polygon.hpp"

namespace strandlab::profile {
namespace {

// The part of a polygon in one row or column of cells.
Polygon strip_of(const Polygon& outline, int axis, int cell) {
  const Vec<2> up = Vec<2>::Unit(axis);
  return cut(cut(outline, {-static_cast<double>(cell), up}), {cell + 1.0, -up});
}

double area_of(const Polygon& outline) {
  return std::abs(moments(outline).area);  // a strand's axes may go round either way
}

std::array<int, 2> cells_over(const Polygon& outline, int axis) {
  double low = outline.front()[axis], high = low;
  for (const auto& corner : outline) {
    low = std::min(low, corner[axis]);
    high = std::max(high, corner[axis]);
  }
  return {static_cast<int>(std::floor(low)), static_cast<int>(std::floor(high))};
}

// Number of the raster's cell that a cell beyond its edges counts in.
int cell_in(int cell, int count, bool periodic) {
  return periodic ? (cell % count + count) % count : std::clamp(cell, 0, count - 1);
}

// Spreads a mass evenly over the parallelogram with these edges about a centre, all in cells.
void add(DensityMap& map, const Vec<2>& centre, const Vec<2>& a, const Vec<2>& b, double mass) {
  const Polygon outline{centre - (a + b) / 2, centre + (a - b) / 2, centre + (a + b) / 2, centre - (a - b) / 2};
  const double whole = area_of(outline);
  if (!(whole > 0)) return;
  const auto [first_row, last_row] = cells_over(outline, 1);
  for (int j = first_row; j <= last_row; ++j) {
    const auto row = strip_of(outline, 1, j);
    if (row.empty()) continue;
    const auto [first, last] = cells_over(row, 0);
    for (int i = first; i <= last; ++i) {
      const auto cell =
          static_cast<std::size_t>(cell_in(j, map.across, map.periodic)) * static_cast<std::size_t>(map.along) +
          static_cast<std::size_t>(cell_in(i, map.along, map.periodic));
      map.kg_m3[cell] += mass * area_of(strip_of(row, 0, i)) / whole;
    }
  }
}

// Sums over zones, from sums over everything left of and below a corner of the raster.
class Sums {
 public:
  explicit Sums(const DensityMap& map) : width_(2 * map.along + 1) {
    sum_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(2 * map.across + 1), 0.0);
    for (int j = 0; j < 2 * map.across; ++j) {
      for (int i = 0; i < 2 * map.along; ++i) {
        at(i + 1, j + 1) = map.at(i % map.along, j % map.across) + at(i, j + 1) + at(i + 1, j) - at(i, j);
      }
    }
  }
  double zone(int i, int j, int size) { return at(i + size, j + size) - at(i, j + size) - at(i + size, j) + at(i, j); }

 private:
  double& at(int i, int j) {
    return sum_[static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i)];
  }
  int width_;
  std::vector<double> sum_;
};

}  // namespace

DensityMap density_map(const Panel<3>& panel, double cell_mm) {
  if (!(cell_mm > 0))
    throw InputError(fmt::format("a density map in cells of {} mm: a positive size is needed", cell_mm));
  if (!(panel.thickness_mm() > 0)) throw InputError("a density map needs a panel with a thickness");
  DensityMap map;
  map.along = divisions(panel.length_mm, cell_mm);
  map.across = divisions(panel.depth_mm, cell_mm);
  map.cell_x_mm = panel.length_mm / map.along;
  map.cell_y_mm = panel.depth_mm / map.across;
  map.periodic = panel.periodic;
  map.kg_m3.assign(static_cast<std::size_t>(map.along) * static_cast<std::size_t>(map.across), 0.0);
  const Vec<2> cells(1 / map.cell_x_mm, 1 / map.cell_y_mm);
  const double column = map.cell_x_mm * map.cell_y_mm * panel.thickness_mm();
  for (const auto& strand : panel.strands) {
    const double mass = strand.material.density / kTonnePerMm3 * strand.lattice.point_volume();  // kg/m^3 mm^3
    for (std::size_t p = 0; p < strand.size(); ++p) {
      const auto& F = strand.points.F[p];
      const auto edge = [&](int axis) -> Vec<2> {
        return cells.cwiseProduct(F.col(axis).head<2>()) * strand.lattice.spacing[axis];
      };
      add(map, cells.cwiseProduct(strand.points.x[p].head<2>()), edge(0), edge(1), mass / column);
    }
  }
  return map;
}

double variation(const DensityMap& map, int zone_cells) {
  if (zone_cells < 1 || zone_cells > std::min(map.along, map.across))
    throw InputError(fmt::format("zones of {} cells on a density map of {} x {}", zone_cells, map.along, map.across));
  Sums sums(map);
  const int last_i = map.periodic ? map.along : map.along - zone_cells + 1;
  const int last_j = map.periodic ? map.across : map.across - zone_cells + 1;
  double mean = 0, square = 0;
  for (int j = 0; j < last_j; ++j) {
    for (int i = 0; i < last_i; ++i) {
      const double zone = sums.zone(i, j, zone_cells);
      mean += zone;
      square += zone * zone;
    }
  }
  const double count = static_cast<double>(last_i) * last_j;
  mean /= count;
  return std::sqrt(std::max(0.0, square / count - mean * mean)) / mean;
}

double void_fraction(const Panel<3>& panel) {
  double wood = 0;
  for (const auto& strand : panel.strands) {
    for (const auto& F : strand.points.F) wood += F.determinant() * strand.lattice.point_volume();
  }
  return 1 - wood / (panel.length_mm * panel.depth_mm * panel.thickness_mm());
}

double poisson_variance(double zone_mm, double length_mm, double width_mm) {
  const auto along = [](double d) { return d <= 1 ? 1 - d / 3 : (1 - 1 / (3 * d)) / d; };
  return along(zone_mm / length_mm) * along(zone_mm / width_mm);
}

}  // namespace strandlab::profile
