#include "strandlab/mpm/checks.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

namespace strandlab::mpm {

std::string moment(const EngineState& state) {
  return fmt::format("step {}, time {:.6g} ms", state.step, 1e3 * state.time_s);
}

template <int Dim>
std::string text(const Vec<Dim>& x) {
  std::string s;
  for (int a = 0; a < Dim; ++a) s += fmt::format("{}{:.4f}", a ? ", " : "", x[a]);
  return s + " mm";
}

template <int Dim>
void check_grid(const Grid<Dim>& grid) {
  for (int a = 0; a < Dim; ++a) {
    if (!(grid.cell[a] > 0))
      throw InputError(fmt::format("grid: cell size {} mm on axis {}; it must be positive", grid.cell[a], a));
    if (!(grid.hi[a] > grid.lo[a])) throw InputError(fmt::format("grid: empty window on axis {}", a));
    if (a == Dim - 1) continue;
    if ((grid.sides[a][0] == Side::kPeriodic) != (grid.sides[a][1] == Side::kPeriodic))
      throw InputError(fmt::format("grid: one side on axis {} is periodic and the other is not", a));
    if (const double cells = (grid.hi[a] - grid.lo[a]) / grid.cell[a];
        grid.sides[a][0] == Side::kPeriodic && std::abs(cells - std::round(cells)) > 1e-6) {
      throw InputError(fmt::format("grid: the period on axis {} must be whole cells, it is {}", a, cells));
    }
    for (int side = 0; side < 2; ++side) {
      if (grid.sides[a][side] != Side::kRoller) continue;
      const double plane = ((side == 0 ? grid.lo[a] : grid.hi[a]) - grid.origin[a]) / grid.cell[a];
      if (std::abs(plane - std::round(plane)) > 1e-6) {
        throw InputError(
            fmt::format("grid: the roller plane on axis {} must lie on a grid line, it is at {} cells", a, plane));
      }
    }
  }
}

template <int Dim>
void check_inside(const std::vector<Particles<Dim>>& bodies, const Grid<Dim>& grid, const EngineState& state) {
  for (const auto& body : bodies) {
    body.each([&](int p, const Vec<Dim>& x, const double*) {
      for (int a = 0; a < Dim; ++a) {
        const auto allowed = [&](int side) {
          if (a < Dim - 1 && grid.sides[a][side] == Side::kRoller) return 0.25 * grid.cell[a];
          return grid.hi[a] - grid.lo[a] + 2 * grid.cell[a];
        };
        if (x[a] >= grid.lo[a] - allowed(0) && x[a] <= grid.hi[a] + allowed(1)) continue;
        throw RunError(
            fmt::format("{}: particle {} of {} left the grid at ({})", moment(state), p, body.name, text<Dim>(x)));
      }
    });
  }
}

template <int Dim>
RunError particle_failure(const Particles<Dim>& body, int block, const EngineState& state) {
  using C = Component<Dim>;
  const double* d = body.block(block);
  std::string what = "stress is not finite";
  int lane = 0;
  for (int l = body.lanes[block] - 1; l >= 0; --l) {
    for (int k = 0; k < body.components; ++k) {
      if (!(std::abs(d[(C::stress + k) * kBlock + l]) < kLargestStress)) lane = l;
    }
  }
  for (int l = 0; l < body.lanes[block]; ++l) {
    const Tensor<Dim> F = body.deformation(d + l);
    double J = F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0);
    if constexpr (Dim == 3) J = Eigen::Matrix3d(F).determinant();
    if (J <= 1e-6) {
      what = fmt::format("inverted (det F = {:.3g})", J);
      lane = l;
      break;
    }
  }
  return RunError(fmt::format("{}: particle {} of {} at ({}): {}", moment(state), body.particle[block * kBlock + lane],
                              body.name, text<Dim>(body.position(d + lane)), what));
}

template std::string text<2>(const Vec<2>&);
template std::string text<3>(const Vec<3>&);
template void check_grid(const Grid<2>&);
template void check_grid(const Grid<3>&);
template void check_inside(const std::vector<Particles<2>>&, const Grid<2>&, const EngineState&);
template void check_inside(const std::vector<Particles<3>>&, const Grid<3>&, const EngineState&);
template RunError particle_failure(const Particles<2>&, int, const EngineState&);
template RunError particle_failure(const Particles<3>&, int, const EngineState&);

}  // namespace strandlab::mpm
