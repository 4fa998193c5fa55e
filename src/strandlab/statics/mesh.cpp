#include "strandlab/statics/mesh.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "strandlab/core/error.hpp"

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

// Moves the nodes of folded elements of one strand, and of a growing neighbourhood, to the mean of their neighbours.
class Straightener {
 public:
  Straightener(const StrandMesh<2>& part, double formed_area, std::vector<Vec<2>>& nodes)
      : part_(part), smallest_(0.1 * formed_area), nodes_(nodes), moves_(nodes.size() - part.first_node) {}

  // Number of elements that were folded. Throws RunError when some still are.
  int run() {
    constexpr int kSweeps = 400, kSweepsPerRing = 20;
    const int found = mark_folded(0);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      if (mark_folded(1 + sweep / kSweepsPerRing) == 0) return found;
      for (int j = 0; j <= part_.through(); ++j) {
        for (int i = 0; i <= part_.along(); ++i) {
          if (moves_[part_.node(i, j) - part_.first_node]) at(i, j) += 0.5 * (smooth(i, j) - at(i, j));
        }
      }
    }
    if (mark_folded(0) == 0) return found;
    throw RunError(
        fmt::format("strand {} is too distorted for a virtual test: folded elements near x = {:.3f} mm, y = {:.3f} mm",
                    part_.strand + 1, folded_[0], folded_[1]));
  }

 private:
  Vec<2>& at(int i, int j) { return nodes_[part_.node(i, j)]; }

  // Twice the area of the smallest of the four corner triangles.
  double smallest_corner(int i, int j) {
    const std::array<Vec<2>, 4> c{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
    double smallest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4; ++k) {
      const Vec<2> next = c[(k + 1) % 4] - c[k], previous = c[(k + 3) % 4] - c[k];
      smallest = std::min(smallest, next[0] * previous[1] - next[1] * previous[0]);
    }
    return smallest;
  }

  // Marks the nodes within `rings` of folded elements as movable; returns the number of such elements.
  int mark_folded(int rings) {
    std::fill(moves_.begin(), moves_.end(), 0);
    int count = 0;
    for (int j = 0; j < part_.through(); ++j) {
      for (int i = 0; i < part_.along(); ++i) {
        if (smallest_corner(i, j) >= smallest_) continue;
        ++count;
        folded_ = at(i, j);
        for (int b = std::max(0, j - rings); b <= std::min(part_.through(), j + 1 + rings); ++b) {
          for (int a = std::max(0, i - rings); a <= std::min(part_.along(), i + 1 + rings); ++a) {
            moves_[part_.node(a, b) - part_.first_node] = 1;
          }
        }
      }
    }
    return count;
  }

  // Inside: the mean of four neighbours; on a face or an end: of the two along it; at a corner: completes the
  // parallelogram.
  Vec<2> smooth(int i, int j) {
    const bool end = i == 0 || i == part_.along(), face = j == 0 || j == part_.through();
    if (end && face) {
      const int a = i == 0 ? 1 : i - 1, b = j == 0 ? 1 : j - 1;
      return at(a, j) + at(i, b) - at(a, b);
    }
    if (end) return 0.5 * (at(i, j - 1) + at(i, j + 1));
    if (face) return 0.5 * (at(i - 1, j) + at(i + 1, j));
    return 0.25 * (at(i - 1, j) + at(i + 1, j) + at(i, j - 1) + at(i, j + 1));
  }

  StrandMesh<2> part_;
  double smallest_;  // mm^2
  std::vector<Vec<2>>& nodes_;
  std::vector<char> moves_;  // by node of the strand
  Vec<2> folded_ = Vec<2>::Zero();
};

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
  if constexpr (Dim == 2) mesh.straightened += Straightener(part, formed, mesh.nodes).run();
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
  const int j = point.side == glue::Side::kTop ? part.through() : 0;
  const int inward = point.side == glue::Side::kTop ? -(part.along() + 1) : part.along() + 1;
  return {part.node(i, j), part.node(i + 1, j), s - i, inward};
}

FacetNodes locate(const Mesh<3>& mesh, const glue::FacePoint<3>& point) {
  const auto& part =
      mesh.strands[static_cast<std::size_t>(mesh.mesh_of_strand[static_cast<std::size_t>(point.strand)])];
  const int k = point.side == glue::Side::kTop ? part.through() : 0;
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
