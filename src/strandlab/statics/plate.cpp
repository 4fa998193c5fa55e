#include "strandlab/statics/plate.hpp"

#include <numeric>

namespace strandlab::statics {
namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

PlateLoads plate_loads(const Mesh<3>& mesh, double middle) {
  PlateLoads loads;
  for (auto& forces : loads.forces) forces.assign(static_cast<std::size_t>(mesh.dofs()), 0.0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto terms = plate_terms(mesh.corners(e), mesh.stiffness[e], middle);
    loads.own += terms.own;
    for (int i = 0; i < kCorners<3>; ++i) {
      const int node = mesh.elements[e][static_cast<std::size_t>(i)];
      for (int a = 0; a < 3; ++a) {
        for (std::size_t k = 0; k < 6; ++k)
          loads.forces[k][static_cast<std::size_t>(3 * node + a)] += terms.loads(3 * i + a, static_cast<int>(k));
      }
    }
  }
  return loads;
}

LoadCase balance(const std::vector<double>& plate_forces) {
  LoadCase load{plate_forces, std::vector<double>(plate_forces.size(), 0.0)};
  for (double& force : load.forces) force = -force;
  return load;
}

PlateResponse plate_response(const BondedPanel<3>& panel, const PlateLoads& loads,
                             const std::vector<Solution<3>>& solutions) {
  PlateResponse response;
  for (std::size_t j = 0; j < 6; ++j) {
    const auto held = panel.forces(solutions[j]);
    for (std::size_t i = 0; i < 6; ++i) {
      const double from_loads = dot(loads.forces[i], solutions[j].displacement);
      const auto row = static_cast<int>(i), column = static_cast<int>(j);
      response.resultants(row, column) = loads.own(row, column) + from_loads;
      response.energy(row, column) = response.resultants(row, column) + dot(solutions[i].displacement, held) +
                                     dot(loads.forces[j], solutions[i].displacement);
    }
  }
  return response;
}

}  // namespace strandlab::statics
