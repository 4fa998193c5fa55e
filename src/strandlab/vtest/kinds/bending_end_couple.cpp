// Bending by an end couple (Le 2010, Eq. 4.1 to 4.3): x = 0 is clamped, axial forces +-P act over the end faces of the
// outermost rows present at x = L, a lever d apart: E_b = M^2 L/(2 U I), M = P d.
#include <algorithm>
#include <utility>

#include "strandlab/core/error.hpp"
#include "strandlab/vtest/end_planes.hpp"
#include "strandlab/vtest/kinds/test.hpp"

namespace strandlab::vtest {
namespace {

// Even axial traction of total force 1 N over the right end face of a strand, and the height at which it acts.
struct EndForce {
  std::vector<std::pair<int, double>> at;  // node, N
  double height = 0;                       // mm
};

EndForce end_force(const statics::Mesh<2>& mesh, const statics::StrandMesh<2>& strand) {
  const double bottom = mesh.nodes[strand.node(strand.along(), 0)][1];
  const double top = mesh.nodes[strand.node(strand.along(), strand.through())][1];
  EndForce force;
  force.height = 0.5 * (bottom + top);
  for (int j = 0; j < strand.through(); ++j) {
    const int lower = strand.node(strand.along(), j), upper = strand.node(strand.along(), j + 1);
    const double half = 0.5 * (mesh.nodes[upper][1] - mesh.nodes[lower][1]) / (top - bottom);
    force.at.emplace_back(lower, half);
    force.at.emplace_back(upper, half);
  }
  return force;
}

// Nodal forces of a couple of moment 1 N mm: an even axial traction over the end face of the outermost strand on either
// side that reaches x = length, pulling below and pushing above. Throws InputError if that is one and the same strand.
std::vector<double> couple_forces(const Connection& connection, const statics::Mesh<2>& mesh) {
  const statics::StrandMesh<2>*lowest = nullptr, *highest = nullptr;
  const auto end_height = [&](const statics::StrandMesh<2>& s) { return mesh.nodes[s.node(s.along(), 0)][1]; };
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

statics::Supports clamped_supports(const Model& model) {
  auto supports = no_supports(model.bonded.stiffness());
  for (const int n : model.section.left) supports.fixed[2 * n] = supports.fixed[2 * n + 1] = 1;
  return supports;
}

// The rotation that the couple works through and the moment that arrives at the clamp give the modulus from reactions.
Modulus end_couple_modulus(const Model& model, const std::vector<double>& couple, const statics::Solution<2>& bent) {
  const auto& section = model.section;
  double rotation = 0;  // work of a couple of 1 N mm
  for (std::size_t i = 0; i < couple.size(); ++i) rotation += couple[i] * bent.displacement[i];
  Modulus modulus{TestKind::kBendingEndCouple};
  modulus.modulus_MPa = section.length / (2 * model.bonded.energy(bent) * section.second_moment());
  modulus.reaction_modulus_MPa = -left_resultant(section, model.bonded.forces(bent)).moment * section.length /
                                 (rotation * section.second_moment());
  return modulus;
}

Setup set_up_end_couple(const Model& model, const Options&) {
  const auto couple = couple_forces(model.connection, model.mesh);
  return {{{couple, nothing(model)}},
          [&model, couple](const Solutions& s) { return end_couple_modulus(model, couple, *s[0]); }};
}

void check_two_strands(const Panel<2>& mat) {
  const auto at_right = connect(mat, {}).at_right;
  if (std::count(at_right.begin(), at_right.end(), true) < 2)
    throw InputError("bending by an end couple needs two strands at the loaded end, the mat has fewer");
}

}  // namespace

template <>
const VirtualTest& test<TestKind::kBendingEndCouple>() {
  static constexpr VirtualTest kTest{.name = "bending_end_couple",
                                     .label = "Bending (end couple)",
                                     .closed_form = ClosedForm::kLaminatedBeam,
                                     .supports = clamped_supports,
                                     .set_up = set_up_end_couple,
                                     .check_mat = check_two_strands};
  return kTest;
}

}  // namespace strandlab::vtest
