#include "strandlab/vtest/plate_model.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "strandlab/core/error.hpp"
#include "strandlab/core/stopwatch.hpp"
#include "strandlab/vtest/plate_connection.hpp"

namespace strandlab::vtest {
namespace {

// Glue points of less than this of an element's area are left out: coordinates on a raster leave such slivers where
// edges lie over edges, and a perfect bond would hold there as well as anywhere.
constexpr double kSliver = 1e-5;

void refuse_pieces(const PlateConnection& connection, bool periodic) {
  if (connection.across_both) return;
  const char* where = !connection.across_x && !connection.across_y ? "x or y" : !connection.across_x ? "x" : "y";
  if (periodic && connection.across_x && connection.across_y) where = "x and y, but along a diagonal only";
  throw NotConnected(
      fmt::format("the panel is not connected across {}: no glue holds strands together all the way", where));
}

// Of all strands' faces.
double face_area(const Panel<3>& panel) {
  double area = 0;
  for (const auto& strand : panel.strands) area += 2 * strand.lattice.extent(0) * strand.lattice.extent(1);
  return area;
}

}  // namespace

PlateModel make_plate_model(const Panel<3>& panel, const PlateOptions& options, PlateResult& result) {
  const Stopwatch watch(result.assemble_s);
  auto curing = options.curing;
  if (curing.point_spacing_mm == 0) curing.point_spacing_mm = options.element_length_mm;
  auto points = glue::cure(panel, curing);
  for (const auto& point : points) result.glued_area_mm2 += point.area;
  result.glued_fraction = 2 * result.glued_area_mm2 / face_area(panel);

  const auto connection = connect(panel, points);
  refuse_pieces(connection, panel.periodic);
  result.strands = static_cast<int>(panel.strands.size());
  result.floating_strands = connection.floating;
  const auto kept = [&](const glue::FacePoint<3>& side) {
    return connection.kept[static_cast<std::size_t>(side.strand)];
  };
  const double sliver = kSliver * options.element_length_mm * options.element_length_mm;
  std::erase_if(points, [&](const auto& point) { return !kept(point.a) || !kept(point.b) || point.area < sliver; });

  auto mesh = statics::make_mesh(panel, connection.kept, options.elements_through_strand, options.element_length_mm);
  result.unknowns = mesh.dofs();
  statics::BondedPanel<3> bonded(mesh, statics::make_springs(mesh, points),
                                 statics::penalty(mesh, options.element_length_mm, options.perfect_bond));
  return {{panel.length_mm, panel.depth_mm},
          panel.thickness_mm(),
          panel.bottom_mm,
          options.curing.max_gap_mm,
          std::move(mesh),
          std::move(points),
          std::move(bonded)};
}

statics::Supports no_supports(const PlateModel& model) {
  statics::Supports supports;
  const auto& k = model.bonded.stiffness();
  supports.fixed.assign(static_cast<std::size_t>(k.size()), 0);
  for (int j = 0; j < k.size(); ++j) {
    supports.diagonal =
        std::max(supports.diagonal, k.value[static_cast<std::size_t>(k.column_start[static_cast<std::size_t>(j)])]);
  }
  return supports;
}

statics::LoadCase no_load(const PlateModel& model) {
  const std::vector<double> nothing(static_cast<std::size_t>(model.mesh.dofs()), 0.0);
  return {nothing, nothing};
}

}  // namespace strandlab::vtest
