#include "strandlab/statics/mesh.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "strandlab/statics/straighten.hpp"

namespace strandlab::statics {
namespace {

constexpr double kRoundOff = 1e-9;  // of lattice coordinates, in points

// A corner of the lattice is taken as it is.
double snapped(double coordinate) {
  const double nearest = std::round(coordinate);
  return std::abs(coordinate - nearest) < kRoundOff ? nearest : coordinate;
}

// Mean grain direction of the points that an element covers.
Vec<2> grain_between(const Strand<2>& strand, const Vec<2>& from, const Vec<2>& to) {
  Vec<2> sum = Vec<2>::Zero();
  for_each_covered(strand.lattice, from, to, [&](std::size_t p, double weight) {
    if (weight > kRoundOff) sum += weight * grain(strand.points.F[p]);
  });
  return sum.normalized();
}

// Unit axes of the strand where an element is, from the points that it covers: along is the material line of the grain,
// thickness is perpendicular to it and to the material line across.
Tensor<3> axes_between(const Strand<3>& strand, const Vec<3>& from, const Vec<3>& to) {
  Tensor<3> sum = Tensor<3>::Zero();
  for_each_covered(strand.lattice, from, to, [&](std::size_t p, double weight) {
    if (weight > kRoundOff) sum += weight * strand.points.F[p];
  });
  Tensor<3> axes;
  axes.col(0) = sum.col(0).normalized();
  axes.col(2) = axes.col(0).cross(sum.col(1)).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

// Stiffness in panel axes where an element covers the strand's points from..to.
WoodStiffness<2> stiffness_between(const Strand<2>& strand, const Vec<2>& from, const Vec<2>& to) {
  return in_section(strand.material.stiffness, grain_between(strand, from, to));
}
WoodStiffness<3> stiffness_between(const Strand<3>& strand, const Vec<3>& from, const Vec<3>& to) {
  return in_panel(strand.material.stiffness, axes_between(strand, from, to));
}

double measure(const ElementCorners<2>& corners) {
  return area(corners);
}
double measure(const ElementCorners<3>& corners) {
  return volume(corners);
}

// Coordinate of an element's first corner on the strand's lattice of points.
template <int Dim>
Vec<Dim> first_corner(const StrandMesh<Dim>& part, const typename Lattice<Dim>::Place& place) {
  Vec<Dim> coordinate;
  for (int a = 0; a < Dim; ++a) coordinate[a] = place[a] * part.points_per_element[a];
  return coordinate;
}

template <int Dim>
void append_strand(const Strand<Dim>& strand, StrandMesh<Dim> part, Mesh<Dim>& mesh) {
  const auto at_corners = corners(strand);
  const auto& elements = part.elements;
  for (std::size_t c = 0; c < elements.corner_count(); ++c) {
    const Vec<Dim> coordinate = first_corner(part, elements.place_of_corner(c)).unaryExpr(&snapped);
    mesh.nodes.push_back(strand.lattice.between_corners(at_corners, coordinate));
  }
  const double formed = part.points_per_element.prod() * strand.lattice.point_volume();  // V0 of an element
  mesh.straightened += straighten(part, formed, mesh.nodes);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    auto& nodes = mesh.elements.emplace_back();
    const auto cell = elements.cell(e);
    std::transform(cell.begin(), cell.end(), nodes.begin(),
                   [&](std::size_t corner) { return part.first_node + static_cast<int>(corner); });
    const double now = measure(mesh.corners(mesh.elements.size() - 1));
    auto next = elements.place_of_point(e);
    const Vec<Dim> from = first_corner(part, next);
    for (int& n : next) ++n;
    mesh.stiffness.push_back(formed / now * stiffness_between(strand, from, first_corner(part, next)));
  }
}

// Mesh of the kept strands; counts(strand) says the elements of one, by axis.
template <int Dim, class Counts>
Mesh<Dim> mesh_of(const Panel<Dim>& panel, const std::vector<bool>& keep, const Counts& counts) {
  Mesh<Dim> mesh;
  mesh.mesh_of_strand.assign(panel.strands.size(), -1);
  for (std::size_t s = 0; s < panel.strands.size(); ++s) {
    if (!keep[s]) continue;
    const auto& lattice = panel.strands[s].lattice;
    StrandMesh<Dim> part;
    part.strand = static_cast<int>(s);
    part.elements.counts = counts(lattice);
    for (int a = 0; a < Dim; ++a) {
      part.elements.spacing[a] = lattice.extent(a) / part.elements.counts[a];
      part.points_per_element[a] = static_cast<double>(lattice.counts[a]) / part.elements.counts[a];
    }
    part.first_node = static_cast<int>(mesh.nodes.size());
    part.first_element = static_cast<int>(mesh.elements.size());
    append_strand(panel.strands[s], part, mesh);
    mesh.mesh_of_strand[s] = static_cast<int>(mesh.strands.size());
    mesh.strands.push_back(part);
  }
  return mesh;
}

}  // namespace

double element_length(const Panel<2>& panel, int elements_through) {
  return thinnest_strand(panel) / elements_through;
}

Mesh<2> make_mesh(const Panel<2>& panel, const std::vector<bool>& keep, int elements_through) {
  const double length = element_length(panel, elements_through), thinnest = thinnest_strand(panel);
  return mesh_of(panel, keep, [&](const Lattice<2>& strand) {
    return Lattice<2>::Place{divisions(strand.extent(0), length),
                             mat::through(strand.thickness(), thinnest, elements_through)};
  });
}

Mesh<3> make_mesh(const Panel<3>& panel, const std::vector<bool>& keep, int elements_through, double element_length) {
  const double thinnest = thinnest_strand(panel);
  return mesh_of(panel, keep, [&](const Lattice<3>& strand) {
    return Lattice<3>::Place{divisions(strand.extent(0), element_length), divisions(strand.extent(1), element_length),
                             mat::through(strand.thickness(), thinnest, elements_through)};
  });
}

FaceNodes locate(const Mesh<2>& mesh, const glue::FacePoint<2>& point) {
  const auto& part = mesh.strands[mesh.mesh_of_strand[point.strand]];
  const double s = (point.segment + point.xi) / part.points_per_element[0];
  const int i = std::clamp(static_cast<int>(s), 0, part.along() - 1);
  const int j = point.face == glue::StrandFace::kTop ? part.through() : 0;
  const int inward = point.face == glue::StrandFace::kTop ? -(part.along() + 1) : part.along() + 1;
  return {part.node(i, j), part.node(i + 1, j), s - i, inward};
}

FacetNodes locate(const Mesh<3>& mesh, const glue::FacePoint<3>& point) {
  const auto& part =
      mesh.strands[static_cast<std::size_t>(mesh.mesh_of_strand[static_cast<std::size_t>(point.strand)])];
  const int k = point.face == glue::StrandFace::kTop ? part.through() : 0;
  std::array<int, 2> cell{};
  Vec<2> place;
  for (int a = 0; a < 2; ++a) {
    const double s = snapped(point.place[a] / part.points_per_element[a]);
    cell[a] = std::clamp(static_cast<int>(s), 0, part.elements.counts[a] - 1);
    place[a] = 2 * (s - cell[a]) - 1;
  }
  const auto [i, j] = cell;
  return {{part.node(i, j, k), part.node(i + 1, j, k), part.node(i + 1, j + 1, k), part.node(i, j + 1, k)}, place};
}

}  // namespace strandlab::statics
