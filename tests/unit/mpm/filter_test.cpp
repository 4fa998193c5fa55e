// XPIC(2), Hammerquist & Nairn (2017): v_p = S (2 v - S+ S v), with S from nodes to particles, S+ from particles to
// nodes by mass, and v the nodes' velocities after the step.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <map>
#include <random>

#include "strandlab/mpm/engine.hpp"
#include "strandlab/mpm/gimp.hpp"
#include "support/near.hpp"
#include "support/strands.hpp"

namespace strandlab::mpm {
namespace {

constexpr double kFilterCell = 0.5;  // mm

// A block of 6^Dim particles, two per cell and axis, of random velocities so small that it moves by nothing.
template <int Dim>
Body<Dim> noisy_block() {
  std::mt19937 random(5);
  std::uniform_real_distribution<> unit(-1, 1);
  std::array<int, Dim> counts{};
  counts.fill(6);
  auto s = test::strand_from<Dim>(wood::in_strand_axes(wood::library().front(), 0), Vec<Dim>::Constant(0.07),
                                  Vec<Dim>::Constant(kFilterCell / 2), counts);
  s.kind = "surface";
  for (auto& v : s.points.v) {
    for (int a = 0; a < Dim; ++a) v[a] = 1e-6 * unit(random);
  }
  return body_of(s);
}

// S as a dense matrix: weights of the nodes (columns) at the particles (rows), from the grid functions' definition.
template <int Dim>
Eigen::MatrixXd weights(const Body<Dim>& body) {
  std::map<std::array<int, Dim>, Eigen::Index> nodes;
  std::vector<std::tuple<Eigen::Index, Eigen::Index, double>> entries;
  for (std::size_t p = 0; p < body.points.x.size(); ++p) {
    std::array<int, Dim> node;
    std::array<Gimp<double>, Dim> axis;
    for (int a = 0; a < Dim; ++a) {
      const double xi = body.points.x[p][a] / kFilterCell;
      node[a] = static_cast<int>(std::lround(xi));
      axis[a] = gimp<double>(xi - node[a], 0.25);
    }
    for (int q = 0; q < (Dim == 2 ? 9 : 27); ++q) {
      std::array<int, Dim> at = node;
      double w = 1;
      int rest = q;
      for (int a = 0; a < Dim; ++a) {
        at[a] += rest % 3 - 1;
        w *= axis[a].weight[rest % 3];
        rest /= 3;
      }
      if (w == 0) continue;
      const auto number = nodes.emplace(at, static_cast<Eigen::Index>(nodes.size())).first->second;
      entries.emplace_back(static_cast<Eigen::Index>(p), number, w);
    }
  }
  Eigen::MatrixXd S =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(body.points.x.size()), static_cast<Eigen::Index>(nodes.size()));
  for (const auto& [p, i, w] : entries) S(p, i) += w;
  return S;
}

template <int Dim>
void expect_filtered() {
  std::vector<Body<Dim>> bodies{noisy_block<Dim>()};
  const auto count = static_cast<Eigen::Index>(bodies[0].points.x.size());
  const Eigen::MatrixXd S = weights(bodies[0]);
  const Eigen::MatrixXd to_nodes = S.colwise().sum().cwiseInverse().asDiagonal() * S.transpose();
  Eigen::MatrixXd v(count, Dim);
  for (Eigen::Index p = 0; p < count; ++p) v.row(p) = bodies[0].points.v[static_cast<std::size_t>(p)].transpose();
  const Eigen::MatrixXd at_nodes = to_nodes * v;
  const Eigen::MatrixXd expected = S * (2 * at_nodes - to_nodes * (S * at_nodes));
  Grid<Dim> grid;
  grid.cell = Vec<Dim>::Constant(kFilterCell);
  grid.origin = Vec<Dim>::Zero();
  grid.lo = Vec<Dim>::Constant(-2);
  grid.hi = Vec<Dim>::Constant(6);
  Options options;
  options.filter_interval = 1;
  Engine<Dim> engine(bodies, grid, options);
  engine.step();
  engine.write(bodies);
  Eigen::MatrixXd filtered(count, Dim);
  for (Eigen::Index p = 0; p < count; ++p)
    filtered.row(p) = bodies[0].points.v[static_cast<std::size_t>(p)].transpose();
  EXPECT_THAT(filtered, test::VecNear(expected, 1e-14));  // mm/s, of 1e-6
}

TEST(VelocityFilter, IsXpicOfSecondOrder2D) {
  expect_filtered<2>();
}
TEST(VelocityFilter, IsXpicOfSecondOrder3D) {
  expect_filtered<3>();
}

}  // namespace
}  // namespace strandlab::mpm
