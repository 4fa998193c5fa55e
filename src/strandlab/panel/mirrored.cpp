#include "strandlab/panel/mirrored.hpp"

#include <algorithm>

namespace strandlab {
namespace {

Strand<3> mirror_image(const Strand<3>& strand, double plane_mm) {
  const Vec<3> mirror(1, 1, -1);
  auto image = strand;
  for (std::size_t p = 0; p < strand.size(); ++p) {
    auto place = strand.lattice.place_of_point(p);
    place[2] = strand.lattice.counts[2] - 1 - place[2];
    const auto from = strand.lattice.point(place);
    for_each_field_of<3>(strand.points, [&](const auto& field) {
      (image.points.*field.values)[p] = (strand.points.*field.values)[from];
    });
    auto& points = image.points;
    points.x[p] = mirror.cwiseProduct(points.x[p]);
    points.x[p][2] += 2 * plane_mm;
    points.v[p] = mirror.cwiseProduct(points.v[p]);
    points.F[p] = mirror.asDiagonal() * points.F[p] * mirror.asDiagonal();
    points.stress[p][3] *= -1;  // 23 and 13, in axes along, across, thickness
    points.stress[p][4] *= -1;
  }
  return image;
}

}  // namespace

Panel<3> with_mirror_image(const Panel<3>& upper) {
  auto whole = upper;
  int rows = 0;
  for (const auto& strand : upper.strands) rows = std::max(rows, strand.row + 1);
  whole.strands.clear();
  for (int row = rows - 1; row >= 0; --row) {
    for (const auto& strand : upper.strands) {
      if (strand.row != row) continue;
      whole.strands.push_back(mirror_image(strand, upper.bottom_mm));
      whole.strands.back().row = rows - 1 - row;
    }
  }
  for (const auto& strand : upper.strands) {
    whole.strands.push_back(strand);
    whole.strands.back().row = rows + strand.row;
  }
  whole.bottom_mm = 2 * upper.bottom_mm - upper.top_mm;
  whole.initial_thickness_mm = 2 * upper.initial_thickness_mm;
  return whole;
}

}  // namespace strandlab
