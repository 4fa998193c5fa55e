// A panel under plate strains: the forces that they make, and the plate stiffness that displacements beyond them leave.
#pragma once

#include <array>
#include <vector>

#include "strandlab/statics/bonded.hpp"

namespace strandlab::statics {

// Forces on the dofs that each of the six plate strains makes where nothing moves beyond it (N, and N mm for
// curvatures), and the stiffness there, the sums of all elements (plate_terms).
struct PlateLoads {
  std::array<std::vector<double>, 6> forces;
  PlateStiffness own = PlateStiffness::Zero();
};
PlateLoads plate_loads(const Mesh<3>& mesh, double middle);

// The load case of a plate strain: what moves beyond it balances its forces. Nothing else is given.
LoadCase balance(const std::vector<double>& plate_forces);

// Stiffness against plate strains, of all that a mesh holds (N mm; per area: N/mm, N and N mm), from the solutions of
// the six load cases: by energy, 2 U of two of them together, and by the resultants of the stresses. They agree where
// the solutions are in equilibrium.
struct PlateResponse {
  PlateStiffness energy, resultants;
};
PlateResponse plate_response(const BondedPanel<3>& panel, const PlateLoads& loads,
                             const std::vector<Solution<3>>& solutions);

}  // namespace strandlab::statics
