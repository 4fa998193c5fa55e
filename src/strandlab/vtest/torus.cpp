// The plate stiffness of a periodic panel: six plate strains act on it everywhere, and what its strands move beyond
// them is held in place at one node only.
#include <Eigen/LU>

#include "strandlab/vtest/plate_model.hpp"

namespace strandlab::vtest {
namespace {

constexpr std::array<const char*, 6> kNames{"plate_E_x",  "plate_E_y",  "plate_G_xy",
                                            "plate_Eb_x", "plate_Eb_y", "plate_Gb_xy"};

// Moduli of a plate that is free to bend and shear, in the order of kNames.
std::array<double, 6> moduli_of(const statics::PlateStiffness& abd, double h) {
  const statics::PlateStiffness s = abd.inverse();
  std::array<double, 6> moduli{};
  for (int k = 0; k < 6; ++k) moduli[static_cast<std::size_t>(k)] = (k < 3 ? 1 / h : 12 / (h * h * h)) / s(k, k);
  return moduli;
}

}  // namespace

void test_torus(PlateModel& model, const statics::PlateLoads& loads, const Solver& solver, PlateResult& result) {
  auto supports = no_supports(model);
  for (std::size_t a = 0; a < 3; ++a) supports.fixed[a] = 1;
  std::vector<statics::LoadCase> cases;
  for (const auto& forces : loads.forces) cases.push_back(statics::balance(forces));
  const auto solutions = model.bonded.solve(supports, cases, solver.times, solver.before_solve);
  const auto response = statics::plate_response(model.bonded, loads, solutions);
  const double area = model.window.prod();
  PlateTensor tensor{0, response.energy / area, response.resultants / area};
  const auto by_energy = moduli_of(tensor.abd, model.thickness);
  const auto by_resultants = moduli_of(tensor.abd_resultants, model.thickness);
  for (std::size_t k = 0; k < kNames.size(); ++k)
    result.moduli.push_back({kNames[k], 0, by_energy[k], by_resultants[k]});
  result.tensors.push_back(std::move(tensor));
}

}  // namespace strandlab::vtest
