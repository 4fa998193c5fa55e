#include "strandlab/vtest/model.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "strandlab/core/error.hpp"
#include "strandlab/core/stopwatch.hpp"

namespace strandlab::vtest {
namespace {

constexpr double kFewFolded = 1e-3;  // of the elements: corners of single strands; judgement

Section make_section(const Panel<2>& panel, const Connection& connection, const statics::Mesh<2>& mesh) {
  Section section;
  section.length = panel.length_mm;
  section.thickness = panel.thickness_mm();
  section.middle = 0.5 * (panel.bottom_mm + panel.top_mm);
  std::vector<char> pinned(static_cast<std::size_t>(connection.groups), 0);
  for (const auto& strand : mesh.strands) {
    for (int j = 0; j <= strand.through(); ++j) {
      if (connection.at_left[strand.strand]) section.left.push_back(strand.node(0, j));
      if (connection.at_right[strand.strand]) section.right.push_back(strand.node(strand.along(), j));
    }
    auto& group_pinned = pinned[connection.group[strand.strand]];
    if (!group_pinned) section.pins.push_back(strand.node(0, 0));
    group_pinned = 1;
  }
  section.nodes = mesh.nodes;
  return section;
}

// Part of the length of facing rows' faces that is glued. Glue lines are measured on the lower strand's face: where
// that is the longer of the two the sum may pass 1.
double glued_fraction(const Panel<2>& panel, const std::vector<glue::GluePoint<2>>& points) {
  double glued = 0;
  for (const auto& point : points) glued += point.area;
  const double facing = glue::facing_length(panel);
  return facing > 0 ? std::min(1.0, 2 * glued / facing) : 0;
}

}  // namespace

Model make_model(const Panel<2>& panel, const Options& options, Result& result) {
  const Stopwatch watch(result.assemble_s);
  const double spacing = statics::element_length(panel, options.elements_through_strand);
  auto curing = options.curing;
  if (curing.point_spacing_mm == 0) curing.point_spacing_mm = spacing;
  auto points = glue::cure(panel, curing);
  result.glued_fraction = glued_fraction(panel, points);

  auto connection = connect(panel, points);
  const auto& group = connection.group;
  if (connection.groups == 0)
    throw InputError("no strands connect the two ends of the panel: there is nothing to test");
  result.strands = static_cast<int>(group.size());
  result.floating_strands = connection.floating;
  std::erase_if(points, [&](const auto& point) { return group[point.a.strand] < 0; });

  std::vector<bool> keep(group.size());
  std::transform(group.begin(), group.end(), keep.begin(), [](int g) { return g >= 0; });
  auto mesh = statics::make_mesh(panel, keep, options.elements_through_strand);
  auto section = make_section(panel, connection, mesh);
  std::vector<bool> at_end(mesh.nodes.size());
  for (const int n : section.left) at_end[n] = true;
  for (const int n : section.right) at_end[n] = true;
  statics::BondedPanel<2> bonded(mesh, statics::make_springs(mesh, points, at_end),
                                 statics::penalty(mesh, spacing, options.perfect_bond));
  result.unknowns = mesh.dofs();
  if (mesh.straightened > kFewFolded * static_cast<double>(mesh.elements.size())) {
    result.warnings.push_back(
        fmt::format("{} of {} elements were folded over, as dragged strand corners are, and were straightened.",
                    mesh.straightened, mesh.elements.size()));
  }
  return {std::move(connection), std::move(mesh), std::move(section), std::move(points), std::move(bonded)};
}

statics::Supports no_supports(const statics::LowerMatrix& stiffness) {
  statics::Supports supports;
  supports.fixed.assign(static_cast<std::size_t>(stiffness.size()), 0);
  for (int j = 0; j < stiffness.size(); ++j) {
    supports.diagonal = std::max(supports.diagonal, stiffness.value[stiffness.column_start[j]]);
  }
  return supports;
}

std::vector<double> nothing(const Model& model) {
  return std::vector<double>(static_cast<std::size_t>(model.mesh.dofs()), 0.0);
}

}  // namespace strandlab::vtest
