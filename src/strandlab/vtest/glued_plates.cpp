// A panel between rigid plates glued to both faces: planar shear, and the thickness modulus with nothing moving
// sideways.
#include "strandlab/core/error.hpp"
#include "strandlab/vtest/plate_model.hpp"

namespace strandlab::vtest {
namespace {

// Nodes of strands' faces that lie at a platen, within the curing gap: of bottom faces (end 0) or top faces (end 1).
std::vector<int> at_platen(const PlateModel& model, int end) {
  const double height = model.bottom + end * model.thickness;
  std::vector<int> nodes;
  for (const auto& strand : model.mesh.strands) {
    for (const auto corner : strand.elements.face_corners(end == 0 ? kBottom<3> : kTop<3>)) {
      const int node = strand.first_node + static_cast<int>(corner);
      if (std::abs(model.mesh.nodes[static_cast<std::size_t>(node)][2] - height) <= model.max_gap)
        nodes.push_back(node);
    }
  }
  return nodes;
}

}  // namespace

void test_glued_plates(PlateModel& model, const Solver& solver, PlateResult& result) {
  const auto bottom = at_platen(model, 0), top = at_platen(model, 1);
  if (bottom.empty() || top.empty())
    throw InputError("no strand lies at the lower or the upper platen to be glued to a plate");
  auto supports = no_supports(model);
  for (const auto* nodes : {&bottom, &top}) {
    for (const int node : *nodes) {
      for (int a = 0; a < 3; ++a) supports.fixed[static_cast<std::size_t>(3 * node + a)] = 1;
    }
  }
  std::vector<statics::LoadCase> cases;  // the upper plate moves by 1 mm
  for (int a = 0; a < 3; ++a) {
    cases.push_back(no_load(model));
    for (const int node : top) cases.back().given[static_cast<std::size_t>(3 * node + a)] = 1;
  }
  const auto solutions = model.bonded.solve(supports, cases, solver.times, solver.before_solve);
  constexpr std::array<const char*, 3> kNames{"plates_G_xz", "plates_G_yz", "plates_E_z"};
  const double factor = model.thickness / model.window.prod();  // of a force: stress over strain
  for (std::size_t a = 0; a < 3; ++a) {
    double reaction = 0;
    const auto forces = model.bonded.forces(solutions[a]);
    for (const int node : bottom) reaction -= forces[static_cast<std::size_t>(3 * node) + a];
    result.moduli.push_back({kNames[a], 0, 2 * model.bonded.energy(solutions[a]) * factor, reaction * factor});
  }
}

}  // namespace strandlab::vtest
