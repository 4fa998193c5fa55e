#include "strandlab/vtest/load_cases.hpp"

#include <algorithm>

#include "strandlab/core/error.hpp"

namespace strandlab::vtest {
namespace {

// Even axial traction of total force 1 N over the right end face of a strand, and the height at which it acts.
struct EndForce {
  std::vector<std::pair<int, double>> at;  // node, N
  double height = 0;                       // mm
};

EndForce end_force(const statics::Mesh& mesh, const statics::StrandMesh& strand) {
  const double bottom = mesh.nodes[strand.node(strand.along, 0)][1];
  const double top = mesh.nodes[strand.node(strand.along, strand.through)][1];
  EndForce force;
  force.height = 0.5 * (bottom + top);
  for (int j = 0; j < strand.through; ++j) {
    const int lower = strand.node(strand.along, j), upper = strand.node(strand.along, j + 1);
    const double half = 0.5 * (mesh.nodes[upper][1] - mesh.nodes[lower][1]) / (top - bottom);
    force.at.emplace_back(lower, half);
    force.at.emplace_back(upper, half);
  }
  return force;
}

Resultant resultant(const std::vector<Vec<2>>& positions, const std::vector<int>& nodes, const Vec<2>& about,
                    const std::vector<double>& forces) {
  Resultant sum;
  for (const int n : nodes) {
    const Vec<2> arm = positions[n] - about;
    sum.force += forces[2 * n];
    sum.moment += arm[0] * forces[2 * n + 1] - arm[1] * forces[2 * n];
  }
  return sum;
}

}  // namespace

Section make_section(const Panel<2>& panel, const Connection& connection, const statics::Mesh& mesh) {
  Section section;
  section.length = panel.length_mm;
  section.thickness = panel.thickness_mm();
  section.middle = 0.5 * (panel.bottom_mm + panel.top_mm);
  std::vector<char> pinned(static_cast<std::size_t>(connection.groups), 0);
  for (const auto& strand : mesh.strands) {
    for (int j = 0; j <= strand.through; ++j) {
      if (connection.at_left[strand.strand]) section.left.push_back(strand.node(0, j));
      if (connection.at_right[strand.strand]) section.right.push_back(strand.node(strand.along, j));
    }
    auto& group_pinned = pinned[connection.group[strand.strand]];
    if (!group_pinned) section.pins.push_back(strand.node(0, 0));
    group_pinned = 1;
  }
  section.nodes = mesh.nodes;
  return section;
}

statics::Supports no_supports(const statics::LowerMatrix& stiffness) {
  statics::Supports supports;
  supports.fixed.assign(static_cast<std::size_t>(stiffness.size()), 0);
  for (int j = 0; j < stiffness.size(); ++j) {
    supports.diagonal = std::max(supports.diagonal, stiffness.value[stiffness.column_start[j]]);
  }
  return supports;
}

statics::Supports end_plane_supports(const Section& section, const statics::LowerMatrix& stiffness) {
  auto supports = no_supports(stiffness);
  for (const int n : section.left) supports.fixed[2 * n] = 1;
  for (const int n : section.right) supports.fixed[2 * n] = 1;
  for (const int n : section.pins) supports.fixed[2 * n + 1] = 1;
  return supports;
}

statics::Supports clamped_supports(const Section& section, const statics::LowerMatrix& stiffness) {
  auto supports = no_supports(stiffness);
  for (const int n : section.left) supports.fixed[2 * n] = supports.fixed[2 * n + 1] = 1;
  return supports;
}

std::vector<double> end_displacement(const Section& section, double q, double theta) {
  std::vector<double> displacement(2 * section.nodes.size(), 0.0);
  for (const int n : section.right) displacement[2 * n] = q - theta * (section.nodes[n][1] - section.middle);
  return displacement;
}

Resultant left_resultant(const Section& section, const std::vector<double>& forces) {
  return resultant(section.nodes, section.left, Vec<2>(0, section.middle), forces);
}

Resultant right_resultant(const Section& section, const std::vector<double>& forces) {
  return resultant(section.nodes, section.right, Vec<2>(section.length, section.middle), forces);
}

std::vector<double> couple_forces(const Connection& connection, const statics::Mesh& mesh) {
  const statics::StrandMesh *lowest = nullptr, *highest = nullptr;
  const auto end_height = [&](const statics::StrandMesh& s) { return mesh.nodes[s.node(s.along, 0)][1]; };
  for (const auto& strand : mesh.strands) {
    if (!connection.at_right[strand.strand]) continue;
    if (lowest == nullptr || end_height(strand) < end_height(*lowest)) lowest = &strand;
    if (highest == nullptr || end_height(strand) > end_height(*highest)) highest = &strand;
  }
  if (lowest == highest)
    throw InputError("bending by an end couple needs two strands at the loaded end, the panel has one");
  const EndForce below = end_force(mesh, *lowest), above = end_force(mesh, *highest);
  const double force = 1 / (above.height - below.height);
  std::vector<double> forces(2 * mesh.nodes.size(), 0.0);
  for (const auto& [node, share] : below.at) forces[2 * node] += force * share;
  for (const auto& [node, share] : above.at) forces[2 * node] -= force * share;
  return forces;
}

}  // namespace strandlab::vtest
