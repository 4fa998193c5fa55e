// Panels whose strands end at the window, with plane ends: tension, end rotation, and shear that is given on all sides.
#include <algorithm>

#include "strandlab/vtest/plate_model.hpp"
#include "strandlab/vtest/specimen.hpp"

namespace strandlab::vtest {
namespace {

std::size_t dof(int node, int axis) {
  return static_cast<std::size_t>(3 * node + axis);
}

const Vec<3>& position(const PlateModel& model, int node) {
  return model.mesh.nodes[static_cast<std::size_t>(node)];
}

// Nodes of strands' ends and edges that lie at an end plane of an axis (0: x, 1: y), low or high.
std::vector<int> at_plane(const PlateModel& model, int axis, bool high) {
  const double plane = high ? model.window[axis] : 0;
  std::vector<int> nodes;
  for (const auto& strand : model.mesh.strands) {
    const double tolerance =
        kCreep * strand.elements.spacing.head<2>().cwiseQuotient(strand.points_per_element.head<2>()).minCoeff();
    for (const auto& face : {kLeftEnd, kRightEnd, kNearEdge, kFarEdge}) {
      for (const auto corner : strand.elements.face_corners(face)) {
        const int node = strand.first_node + static_cast<int>(corner);
        if (std::abs(position(model, node)[axis] - plane) < tolerance) nodes.push_back(node);
      }
    }
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

// Of nodes, the one that is furthest along a direction.
int furthest(const PlateModel& model, const std::vector<int>& nodes, const Vec<3>& direction) {
  return *std::max_element(nodes.begin(), nodes.end(), [&](int a, int b) {
    return position(model, a).dot(direction) < position(model, b).dot(direction);
  });
}

struct Resultant3 {
  double force = 0, moment = 0;  // N, N mm about the middle, positive with the rotation
};

// Of nodal forces at an end plane; the rotation theta moves it by -theta (z - middle).
Resultant3 resultant(const PlateModel& model, const std::vector<int>& nodes, int axis,
                     const std::vector<double>& forces) {
  Resultant3 sum;
  for (const int node : nodes) {
    const double force = forces[dof(node, axis)];
    sum.force += force;
    sum.moment -= (position(model, node)[2] - model.middle()) * force;
  }
  return sum;
}

// Tension and bending along an axis: both end planes held in it; of the rigid motions that are left one end's lowest
// corners hold those across and the turn about the axis.
void test_along(PlateModel& model, int axis, const Solver& solver, PlateResult& result) {
  const int other = 1 - axis;
  const auto low = at_plane(model, axis, false), high = at_plane(model, axis, true);
  auto supports = no_supports(model);
  for (const auto* nodes : {&low, &high}) {
    for (const int node : *nodes) supports.fixed[dof(node, axis)] = 1;
  }
  const Vec<3> across = Vec<3>::Unit(other), down = -1e-3 * Vec<3>::UnitZ();
  const int near = furthest(model, low, down - across), far = furthest(model, low, down + across);
  supports.fixed[dof(near, other)] = supports.fixed[dof(near, 2)] = supports.fixed[dof(far, 2)] = 1;

  auto stretch = no_load(model), turn = no_load(model);  // by 1 mm, by 1 rad
  for (const int node : high) {
    stretch.given[dof(node, axis)] = 1;
    turn.given[dof(node, axis)] = -(position(model, node)[2] - model.middle());
  }
  const auto solutions = model.bonded.solve(supports, {stretch, turn}, solver.times, solver.before_solve);
  const auto end = [&](const statics::Solution<3>& s) { return resultant(model, high, axis, model.bonded.forces(s)); };
  const auto pulled = end(solutions[0]);
  auto bent = solutions[1];  // at no axial force
  bent.add(-end(solutions[1]).force / pulled.force, solutions[0]);

  const double length = model.window[axis], width = model.window[other], h = model.thickness;
  const double per_stretch = length / (width * h), per_turn = length / (width * h * h * h / 12);
  const std::string suffix = axis == 0 ? "_x" : "_y";
  result.moduli.push_back(
      {"tension" + suffix, 0, 2 * model.bonded.energy(solutions[0]) * per_stretch, pulled.force * per_stretch});
  result.moduli.push_back(
      {"bending" + suffix, 0, 2 * model.bonded.energy(bent) * per_turn, end(bent).moment * per_turn});
}

// All four sides given u_x = y/2, u_y = x/2, a shear of 1.
void test_given_shear(PlateModel& model, const Solver& solver, PlateResult& result) {
  auto supports = no_supports(model);
  auto load = no_load(model);
  std::vector<int> sides;
  for (const int axis : {0, 1}) {
    for (const bool high : {false, true}) {
      const auto nodes = at_plane(model, axis, high);
      sides.insert(sides.end(), nodes.begin(), nodes.end());
    }
  }
  for (const int node : sides) {
    for (const int axis : {0, 1}) {
      supports.fixed[dof(node, axis)] = 1;
      load.given[dof(node, axis)] = 0.5 * position(model, node)[1 - axis];
    }
  }
  const Vec<3> down = -1e-3 * Vec<3>::UnitZ();
  for (const auto& towards : {Vec<3>(-1, -1, 0), Vec<3>(1, -1, 0), Vec<3>(-1, 1, 0)})
    supports.fixed[dof(furthest(model, sides, towards + down), 2)] = 1;
  const auto solution = model.bonded.solve(supports, {load}, solver.times, solver.before_solve).front();
  const auto forces = model.bonded.forces(solution);
  double work = 0;  // of the sides, twice the energy
  for (std::size_t i = 0; i < forces.size(); ++i) {
    if (supports.fixed[i]) work += forces[i] * solution.displacement[i];
  }
  result.moduli.push_back(
      {"shear_xy_given", 0, 2 * model.bonded.energy(solution) / model.volume(), work / model.volume()});
}

}  // namespace

void test_plane_ends(PlateModel& model, const Solver& solver, PlateResult& result) {
  for (const int axis : {0, 1}) test_along(model, axis, solver, result);
  test_given_shear(model, solver, result);
}

}  // namespace strandlab::vtest
