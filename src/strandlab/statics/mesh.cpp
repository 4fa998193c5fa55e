#include "strandlab/statics/mesh.hpp"

#include <algorithm>
#include <cmath>

namespace strandlab::statics {
namespace {

// Part of the material points that element k of n covers along one axis: point p counts with weight(p).
struct Cover {
  double from, to;  // in points
  int first() const { return static_cast<int>(std::floor(from + 1e-9)); }
  int last() const { return static_cast<int>(std::ceil(to - 1e-9)) - 1; }
  double weight(int p) const { return std::max(0.0, std::min(to, p + 1.0) - std::max(from, static_cast<double>(p))); }
};

// A strand's corner lattice seen as a continuous map from lattice coordinates (in points) to positions.
class Lattice {
 public:
  explicit Lattice(const Strand<2>& strand) : strand_(strand), corners_(corners(strand)) {}

  Vec<2> position(double s, double t) const {
    const auto [i, a] = split(s, strand_.points[0]);
    const auto [j, b] = split(t, strand_.points[1]);
    return (1 - b) * ((1 - a) * corner(i, j) + a * corner(i + 1, j)) +
           b * ((1 - a) * corner(i, j + 1) + a * corner(i + 1, j + 1));
  }

  // Mean grain direction of the points that an element covers.
  Vec<2> grain_of(const Cover& along, const Cover& through) const {
    Vec<2> sum = Vec<2>::Zero();
    for (int j = through.first(); j <= through.last(); ++j) {
      for (int i = along.first(); i <= along.last(); ++i) {
        const auto p = static_cast<std::size_t>(i) + static_cast<std::size_t>(strand_.points[0]) * j;
        sum += along.weight(i) * through.weight(j) * grain(strand_.F[p]);
      }
    }
    return sum.normalized();
  }

 private:
  struct Place {
    int cell;
    double fraction;
  };
  static Place split(double s, int cells) {
    const double nearest = std::round(s);
    if (std::abs(s - nearest) < 1e-9) s = nearest;  // corners are taken as they are
    const int cell = std::clamp(static_cast<int>(s), 0, cells - 1);
    return {cell, s - cell};
  }
  const Vec<2>& corner(int i, int j) const {
    return corners_[static_cast<std::size_t>(i) + static_cast<std::size_t>(strand_.points[0] + 1) * j];
  }

  const Strand<2>& strand_;
  std::vector<Vec<2>> corners_;
};

void append_strand(const Strand<2>& strand, StrandMesh part, Mesh& mesh) {
  const Lattice lattice(strand);
  const double along = part.points_per_element, through = static_cast<double>(strand.points[1]) / part.through;
  for (int j = 0; j <= part.through; ++j) {
    for (int i = 0; i <= part.along; ++i) mesh.nodes.push_back(lattice.position(i * along, j * through));
  }
  const double formed = along * through * strand.point_volume();  // V0 of an element
  for (int j = 0; j < part.through; ++j) {
    for (int i = 0; i < part.along; ++i) {
      const std::array<int, 4> e{part.node(i, j), part.node(i + 1, j), part.node(i + 1, j + 1), part.node(i, j + 1)};
      const double now = area({mesh.nodes[e[0]], mesh.nodes[e[1]], mesh.nodes[e[2]], mesh.nodes[e[3]]});
      const Vec<2> direction = lattice.grain_of({i * along, (i + 1) * along}, {j * through, (j + 1) * through});
      mesh.elements.push_back(e);
      mesh.stiffness.push_back(formed / now * in_section(strand.material.stiffness, direction));
    }
  }
}

}  // namespace

double element_length(const Panel<2>& panel, int elements_through) {
  const auto& strand = panel.strands.front();
  return strand.points[1] * strand.spacing[1] / elements_through;
}

Mesh make_mesh(const Panel<2>& panel, const std::vector<bool>& keep, int elements_through) {
  Mesh mesh;
  mesh.mesh_of_strand.assign(panel.strands.size(), -1);
  const double length = element_length(panel, elements_through);
  for (std::size_t s = 0; s < panel.strands.size(); ++s) {
    if (!keep[s]) continue;
    const auto& strand = panel.strands[s];
    StrandMesh part;
    part.strand = static_cast<int>(s);
    part.along = std::max(1, static_cast<int>(std::lround(strand.points[0] * strand.spacing[0] / length)));
    part.through = elements_through;
    part.first_node = static_cast<int>(mesh.nodes.size());
    part.first_element = static_cast<int>(mesh.elements.size());
    part.points_per_element = static_cast<double>(strand.points[0]) / part.along;
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
  return {part.node(i, j), part.node(i + 1, j), s - i};
}

}  // namespace strandlab::statics
