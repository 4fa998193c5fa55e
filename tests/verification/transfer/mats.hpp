// Mats of the transfer tests: half a mat between a platen (the top) and its plane of symmetry (the bottom).
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "strandlab/transfer/solver.hpp"

namespace strandlab::transfer::test {

inline constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct HalfMat {
  int cells = 20;
  double thickness = .006, dry_density = 640;  // m, kg/m^3
  double T = 20, M = .08;                      // C, kg/kg
  std::function<double(double)> M_at = {},
                                T_at = {};    // of the depth from the face over the thickness; in place of these
  std::function<double(double)> p_a_at = {};  // in place of one atmosphere less the vapour
};

inline Conditions uniform(const HalfMat& mat, double thickness, const Boundary& face) {
  Conditions c;
  c.thickness.assign(static_cast<std::size_t>(mat.cells), thickness / mat.cells);
  c.top = face;
  return c;
}

inline Solver solver_of(const HalfMat& mat, const Constants& k, const Boundary& face = {}) {
  Grid grid;
  grid.rows = mat.cells;
  grid.dry_mass.assign(static_cast<std::size_t>(mat.cells), mat.dry_density * mat.thickness / mat.cells);
  std::vector<CellState> state;
  for (int i = 0; i < mat.cells; ++i) {
    const double depth = 1 - (i + .5) / mat.cells;
    CellState s{mat.T_at ? mat.T_at(depth) : mat.T, mat.M_at ? mat.M_at(depth) : mat.M, 0};
    s.p_a = mat.p_a_at ? mat.p_a_at(depth) : 101325 - relative_pressure(k, s.T, s.M) * saturation_pressure(s.T);
    state.push_back(s);
  }
  return {k, grid, state, uniform(mat, mat.thickness, face)};
}

// In equal steps.
inline void march(Solver& solver, double to, double step, const ConditionsAt& conditions) {
  const long count = std::lround((to - solver.time()) / step);
  for (long i = 0; i < count; ++i) solver.step(step, conditions);
}

// The largest of the three relative errors, of a step and of all together.
inline double worst_balance(const Solver& solver) {
  double worst = 0;
  for (int row = 0; row < 3; ++row)
    worst = std::max({worst, solver.worst_balance_error()[row], std::abs(solver.drift()[row])});
  return worst;
}

}  // namespace strandlab::transfer::test
