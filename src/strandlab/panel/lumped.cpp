#include "strandlab/panel/lumped.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace strandlab {
namespace {

Strand<2> lumped(const Strand<2>& fine, double spacing_along_mm, int points_through) {
  Strand<2> coarse = fine;
  const auto& counts = fine.lattice.counts;
  const double length = fine.lattice.extent(0), thickness = fine.lattice.thickness();
  coarse.lattice.counts = {std::clamp(static_cast<int>(std::lround(length / spacing_along_mm)), 1, counts[0]),
                           std::min(points_through, counts[1])};
  const auto& [along, through] = coarse.lattice.counts;
  coarse.lattice.spacing = {length / along, thickness / through};
  for_each_field_of<2>(fine.points,
                       [&](const auto& field) { set_zero(coarse.points.*field.values, coarse.lattice.size()); });
  const auto at_corners = corners(fine);
  const Vec<2> step(static_cast<double>(counts[0]) / along, static_cast<double>(counts[1]) / through);
  for (std::size_t p = 0; p < coarse.lattice.size(); ++p) {
    const auto [i, j] = coarse.lattice.place_of_point(p);
    const Vec<2> low(i * step[0], j * step[1]), high = low + step;
    const auto corner = [&](double s, double t) { return fine.lattice.between_corners(at_corners, Vec<2>(s, t)); };
    const Vec<2> a = corner(low[0], low[1]), b = corner(high[0], low[1]), c = corner(low[0], high[1]),
                 d = corner(high[0], high[1]);
    coarse.points.x[p] = 0.25 * (a + b + c + d);
    coarse.points.F[p].col(0) = (b + d - a - c) / (2 * coarse.lattice.spacing[0]);
    coarse.points.F[p].col(1) = (c + d - a - b) / (2 * coarse.lattice.spacing[1]);
    for_each_covered(fine.lattice, low, high, [&](std::size_t q, double weight) {
      const double share = weight / (step[0] * step[1]);
      for_each_field_of<2>(fine.points, [&](const auto& field) {
        if (field.lumped == Lumped::kMean) {
          (coarse.points.*field.values)[p] += share * (fine.points.*field.values)[q];
        }
      });
    });
  }
  return coarse;
}

}  // namespace

Panel<2> lumped(const Panel<2>& panel, double spacing_along_mm, int points_through) {
  if (!(spacing_along_mm > 0) || points_through < 1) throw std::invalid_argument("lumped: no points to lump to");
  Panel<2> coarse = panel;
  for (auto& strand : coarse.strands) strand = lumped(strand, spacing_along_mm, points_through);
  return coarse;
}

}  // namespace strandlab
