#include "strandlab/statics/mesh.hpp"

#include <fmt/format.h>

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
  Straightener(const StrandMesh& part, double formed_area, std::vector<Vec<2>>& nodes)
      : part_(part), smallest_(0.1 * formed_area), nodes_(nodes), moves_(nodes.size() - part.first_node) {}

  // Number of elements that were folded. Throws RunError when some still are.
  int run() {
    constexpr int kSweeps = 400, kSweepsPerRing = 20;
    const int found = mark_folded(0);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      if (mark_folded(1 + sweep / kSweepsPerRing) == 0) return found;
      for (int j = 0; j <= part_.through; ++j) {
        for (int i = 0; i <= part_.along; ++i) {
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
    for (int j = 0; j < part_.through; ++j) {
      for (int i = 0; i < part_.along; ++i) {
        if (smallest_corner(i, j) >= smallest_) continue;
        ++count;
        folded_ = at(i, j);
        for (int b = std::max(0, j - rings); b <= std::min(part_.through, j + 1 + rings); ++b) {
          for (int a = std::max(0, i - rings); a <= std::min(part_.along, i + 1 + rings); ++a) {
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
    const bool end = i == 0 || i == part_.along, face = j == 0 || j == part_.through;
    if (end && face) {
      const int a = i == 0 ? 1 : i - 1, b = j == 0 ? 1 : j - 1;
      return at(a, j) + at(i, b) - at(a, b);
    }
    if (end) return 0.5 * (at(i, j - 1) + at(i, j + 1));
    if (face) return 0.5 * (at(i - 1, j) + at(i + 1, j));
    return 0.25 * (at(i - 1, j) + at(i + 1, j) + at(i, j - 1) + at(i, j + 1));
  }

  StrandMesh part_;
  double smallest_;  // mm^2
  std::vector<Vec<2>>& nodes_;
  std::vector<char> moves_;  // by node of the strand
  Vec<2> folded_ = Vec<2>::Zero();
};

void append_strand(const Strand<2>& strand, StrandMesh part, Mesh& mesh) {
  const auto at_corners = corners(strand);
  const double along = part.points_per_element, through = static_cast<double>(strand.lattice.counts[1]) / part.through;
  for (int j = 0; j <= part.through; ++j) {
    for (int i = 0; i <= part.along; ++i) {
      mesh.nodes.push_back(
          strand.lattice.between_corners(at_corners, Vec<2>(snapped(i * along), snapped(j * through))));
    }
  }
  const double formed = along * through * strand.lattice.point_volume();  // V0 of an element
  mesh.straightened += Straightener(part, formed, mesh.nodes).run();
  for (int j = 0; j < part.through; ++j) {
    for (int i = 0; i < part.along; ++i) {
      const std::array<int, 4> e{part.node(i, j), part.node(i + 1, j), part.node(i + 1, j + 1), part.node(i, j + 1)};
      const double now = area({mesh.nodes[e[0]], mesh.nodes[e[1]], mesh.nodes[e[2]], mesh.nodes[e[3]]});
      const Vec<2> direction = grain_between(strand, {i * along, j * through}, {(i + 1) * along, (j + 1) * through});
      mesh.elements.push_back(e);
      mesh.stiffness.push_back(formed / now * in_section(strand.material.stiffness, direction));
    }
  }
}

}  // namespace

double element_length(const Panel<2>& panel, int elements_through) {
  return thinnest_strand(panel) / elements_through;
}

Mesh make_mesh(const Panel<2>& panel, const std::vector<bool>& keep, int elements_through) {
  Mesh mesh;
  mesh.mesh_of_strand.assign(panel.strands.size(), -1);
  const double length = element_length(panel, elements_through), thinnest = thinnest_strand(panel);
  for (std::size_t s = 0; s < panel.strands.size(); ++s) {
    if (!keep[s]) continue;
    const auto& strand = panel.strands[s];
    StrandMesh part;
    part.strand = static_cast<int>(s);
    part.along = std::max(1, static_cast<int>(std::lround(strand.lattice.extent(0) / length)));
    part.through = mat::through(strand.lattice.thickness(), thinnest, elements_through);
    part.first_node = static_cast<int>(mesh.nodes.size());
    part.first_element = static_cast<int>(mesh.elements.size());
    part.points_per_element = static_cast<double>(strand.lattice.counts[0]) / part.along;
    append_strand(strand, part, mesh);
    mesh.mesh_of_strand[s] = static_cast<int>(mesh.strands.size());
    mesh.strands.push_back(part);
  }
  return mesh;
}

FaceNodes locate(const Mesh& mesh, const glue::FacePoint<2>& point) {
  const auto& part = mesh.strands[mesh.mesh_of_strand[point.strand]];
  const double s = (point.segment + point.xi) / part.points_per_element;
  const int i = std::clamp(static_cast<int>(s), 0, part.along - 1);
  const int j = point.side == glue::Side::kTop ? part.through : 0;
  const int inward = point.side == glue::Side::kTop ? -(part.along + 1) : part.along + 1;
  return {part.node(i, j), part.node(i + 1, j), s - i, inward};
}

}  // namespace strandlab::statics
