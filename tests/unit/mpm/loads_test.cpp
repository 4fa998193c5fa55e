// Loads on bodies in two and three dimensions: gravity and its work, tractions, springs.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "strandlab/mpm/engine.hpp"
#include "support/near.hpp"
#include "support/strands.hpp"

namespace strandlab::mpm {
namespace {

using test::VecNear;

constexpr double kLoadCell = 0.5;  // mm

// A block of 8 (x 6) x 4 particles, two per cell and axis, its lowest corner at `corner`.
template <int Dim>
Body<Dim> block_at(const Vec<Dim>& corner) {
  wood::Material stiff = wood::library().front();
  stiff.hill.Y_R = stiff.hill.Y_T = stiff.hill.S_RT = 1e6;  // never yields
  std::array<int, Dim> counts{};
  counts.fill(6);
  counts[0] = 8;
  counts[Dim - 1] = 4;
  auto s = test::strand_from<Dim>(wood::in_strand_axes(stiff, 0), corner, Vec<Dim>::Constant(kLoadCell / 2), counts);
  s.kind = "block";
  return body_of(s);
}

template <int Dim>
Grid<Dim> open_grid() {
  Grid<Dim> grid;
  grid.cell = Vec<Dim>::Constant(kLoadCell);
  grid.origin = Vec<Dim>::Constant(0.11);
  grid.lo = Vec<Dim>::Constant(-4);
  grid.hi = Vec<Dim>::Constant(12);
  return grid;
}

template <int Dim>
double mass_of(const Body<Dim>& body) {
  return body.material.density * body.lattice.point_volume() * static_cast<double>(body.points.x.size());
}

template <int Dim>
Vec<Dim> mean(const std::vector<Vec<Dim>>& values) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (const auto& v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

// Gravity works m g times the way of the centre of mass, whatever holds the bodies up on it: one block falls free, one
// falls onto another that lies on the platen.
template <int Dim>
void expect_work_of_gravity() {
  constexpr int y = Dim - 1;
  Vec<Dim> g = Vec<Dim>::Constant(2e7);  // mm/s^2: a height of cells within a few hundred steps
  g[y] = -2e8;
  Vec<Dim> apart = Vec<Dim>::Zero(), above = Vec<Dim>::Zero();
  apart[0] = 5;
  apart[y] = 4;
  above[y] = 4 * kLoadCell / 2 + 0.05;
  std::vector<Body<Dim>> bodies{block_at<Dim>(Vec<Dim>::Zero()), block_at<Dim>(above), block_at<Dim>(apart)};
  for (auto& v : bodies[1].points.v) v[y] = -20000;  // mm/s: over the gap within 70 steps
  std::vector<Vec<Dim>> start;
  for (const auto& body : bodies) start.push_back(mean<Dim>(body.points.x));
  Engine<Dim> engine(bodies, open_grid<Dim>(), {});
  engine.set_platens({0, 0}, {12, 0});
  engine.set_gravity(g);
  for (int step = 0; step < 300; ++step) engine.step();
  engine.write(bodies);
  double work = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    work += mass_of(bodies[b]) * g.dot(mean<Dim>(bodies[b].points.x) - start[b]);
  EXPECT_NEAR(engine.energies().external_work / work, 1, 1e-9);
  EXPECT_GT(engine.energies().contact, 0);  // they met
  EXPECT_GT(mean<Dim>(bodies[1].points.v)[y], -15000);
  EXPECT_THAT(mean<Dim>(bodies[2].points.v),
              VecNear(Vec<Dim>(engine.state().time_s * g), 1e-9 * g.norm() * engine.state().time_s));
}

TEST(Gravity, WorksWeightTimesHeight2D) {
  expect_work_of_gravity<2>();
}
TEST(Gravity, WorksWeightTimesHeight3D) {
  expect_work_of_gravity<3>();
}

// A block that pokes a tenth of a cell behind a roller is pulled away from it: away from the plane, which stays, all of
// it falls with g, to which the image behind the roller adds mass and weight alike.
template <int Dim>
void expect_fall_from_roller() {
  Grid<Dim> grid = open_grid<Dim>();
  grid.origin[0] = grid.lo[0] = 0;
  grid.sides[0][0] = Side::kRoller;
  Vec<Dim> corner = Vec<Dim>::Constant(1), g = Vec<Dim>::Zero();
  corner[0] = -0.1 * kLoadCell;
  g[0] = 1e7;  // mm/s^2
  std::vector<Body<Dim>> bodies{block_at<Dim>(corner)};
  Engine<Dim> engine(bodies, grid, {});
  engine.set_gravity(g);
  const double dt = engine.state().time_step_s;
  engine.step();
  engine.write(bodies);
  int away = 0;
  for (std::size_t p = 0; p < bodies[0].points.x.size(); ++p) {
    if (bodies[0].points.x[p][0] < 1.5 * kLoadCell) continue;  // nearer ones see nodes of the plane
    EXPECT_THAT(bodies[0].points.v[p], VecNear(Vec<Dim>(dt * g), 1e-12 * dt * g.norm()));
    ++away;
  }
  EXPECT_GT(away, 0);
}

TEST(Gravity, PullsAwayFromARoller2D) {
  expect_fall_from_roller<2>();
}
TEST(Gravity, PullsAwayFromARoller3D) {
  expect_fall_from_roller<3>();
}

// A block that lies on the platen rests on it from the first step on: the nodes that its lower face reaches, those of
// its lowest quarter and more, do not begin to fall. Were its image to fall with it, nothing would press.
template <int Dim>
void expect_carried_by_platen() {
  Vec<Dim> corner = Vec<Dim>::Constant(1), g = Vec<Dim>::Zero();
  corner[Dim - 1] = 0;
  g[Dim - 1] = -1e7;  // mm/s^2
  const std::vector<Body<Dim>> bodies{block_at<Dim>(corner)};
  Engine<Dim> engine(bodies, open_grid<Dim>(), {});
  engine.set_platens({0, 0}, {12, 0});
  engine.set_gravity(g);
  engine.step();
  const double weight = mass_of(bodies[0]) * g.norm();
  EXPECT_GT(engine.bottom_force(), 0.2 * weight);
  EXPECT_LT(engine.bottom_force(), weight);
}

TEST(Gravity, IsCarriedByThePlaten2D) {
  expect_carried_by_platen<2>();
}
TEST(Gravity, IsCarriedByThePlaten3D) {
  expect_carried_by_platen<3>();
}

// A block under uniform stress is at rest under the tractions sigma n on all its faces: the forces cancel at every node
// of the grid (divergence theorem), wherever the faces lie.
template <int Dim>
void expect_tractions_balance_stress() {
  Body<Dim> body = block_at<Dim>(Vec<Dim>::Constant(0.2));
  Voigt tau = Voigt::Zero();
  tau << 3, Dim == 3 ? -2.0 : 0.0, 1, Dim == 3 ? 0.7 : 0.0, 0.5, Dim == 3 ? -0.4 : 0.0;  // MPa; 11 22 33 23 13 12
  for (auto& s : body.points.stress) s = tau;
  Tensor<Dim> sigma;
  if constexpr (Dim == 2)
    sigma << tau[0], tau[4], tau[4], tau[2];
  else
    sigma << tau[0], tau[5], tau[4], tau[5], tau[1], tau[3], tau[4], tau[3], tau[2];
  std::vector<Body<Dim>> bodies{body};
  Engine<Dim> engine(bodies, open_grid<Dim>(), {});
  const double dt = engine.state().time_step_s;
  ASSERT_EQ(body.faces.size(), 2U * Dim);
  for (std::size_t f = 0; f < body.faces.size(); ++f)
    engine.set_traction(0, static_cast<int>(f), sigma * body.faces[f].area[0].normalized());
  engine.step();
  engine.write(bodies);
  const double unbalanced = dt * sigma.norm() / (body.material.density * kLoadCell);  // mm/s, by one face alone
  for (const auto& v : bodies[0].points.v) ASSERT_THAT(v, VecNear(Vec<Dim>(Vec<Dim>::Zero()), 1e-12 * unbalanced));
  EXPECT_NEAR(engine.energies().external_work, 0, 1e-12 * unbalanced);
}

TEST(Traction, BalancesAnEqualStressNodeByNode2D) {
  expect_tractions_balance_stress<2>();
}
TEST(Traction, BalancesAnEqualStressNodeByNode3D) {
  expect_tractions_balance_stress<3>();
}

// One face alone: momentum t A per second, and its work is found again in the block.
template <int Dim>
void expect_traction_pushes() {
  for (std::size_t face = 0; face < 2U * Dim; ++face) {
    std::vector<Body<Dim>> bodies{block_at<Dim>(Vec<Dim>::Constant(0.2))};
    Engine<Dim> engine(bodies, open_grid<Dim>(), {});
    Vec<Dim> traction = Vec<Dim>::Constant(0.3);  // MPa
    traction[Dim - 1] = -0.2;
    engine.set_traction(0, static_cast<int>(face), traction);
    double area = 0;
    for (const auto& a : bodies[0].faces[face].area) area += a.norm();
    for (int step = 0; step < 60; ++step) engine.step();
    const Vec<Dim> expected = engine.state().time_s * area * traction;
    EXPECT_THAT(engine.momentum(), VecNear(expected, 1e-12 * expected.norm())) << bodies[0].faces[face].name;
    const auto e = engine.energies();
    EXPECT_GT(e.external_work, 0);
    EXPECT_NEAR((e.kinetic + e.elastic + e.filter) / e.external_work, 1, 0.01) << bodies[0].faces[face].name;
  }
}

TEST(Traction, PushesByItsAreaAndWorksOnItsWay2D) {
  expect_traction_pushes<2>();
}
TEST(Traction, PushesByItsAreaAndWorksOnItsWay3D) {
  expect_traction_pushes<3>();
}

// A spring between two blocks, of which one moves off: after the first step it is stretched by [u] = v dt; in the
// second it pulls both with area (k_n [u_n] + k_t [u_t]), and holds half that times [u].
template <int Dim>
void expect_spring_pulls() {
  Vec<Dim> other = Vec<Dim>::Zero();
  other[0] = 6;
  std::vector<Body<Dim>> bodies{block_at<Dim>(Vec<Dim>::Zero()), block_at<Dim>(other)};
  Vec<Dim> v = Vec<Dim>::Constant(3), normal = Vec<Dim>::Constant(0.48);  // mm/s
  v[0] = -2;
  normal[0] = 0.6;
  normal[Dim - 1] = std::sqrt(1 - normal.head(Dim - 1).squaredNorm());
  for (auto& velocity : bodies[1].points.v) velocity = v;
  const double area = 0.7, k_t = 20, k_n = 50;
  Engine<Dim> engine(bodies, open_grid<Dim>(), {});
  engine.set_springs(
      {{{0, 3, bodies[0].lattice.spacing * 0.5}, {1, 8, bodies[0].lattice.spacing * -0.3}, normal, area, k_t, k_n}});
  engine.step();
  const double dt1 = engine.state().time_step_s;
  const Vec<Dim> jump = dt1 * v, opening = jump.dot(normal) * normal;
  const Vec<Dim> pull = area * (k_n * opening + k_t * (jump - opening));  // N, on the first block
  EXPECT_NEAR(engine.spring_energy(), 0.5 * pull.dot(jump), 1e-12 * pull.norm() * jump.norm());
  engine.step();
  engine.write(bodies);
  const double dt2 = engine.state().time_step_s;
  const Vec<Dim> of_first = mass_of(bodies[0]) * mean<Dim>(bodies[0].points.v);
  const Vec<Dim> of_second = mass_of(bodies[1]) * (mean<Dim>(bodies[1].points.v) - v);
  EXPECT_THAT(of_first, VecNear(Vec<Dim>(dt2 * pull), 1e-10 * dt2 * pull.norm()));
  EXPECT_THAT(of_second, VecNear(Vec<Dim>(-dt2 * pull), 1e-9 * dt2 * pull.norm()));
}

TEST(Spring, PullsAlongAndAcrossItsNormal2D) {
  expect_spring_pulls<2>();
}
TEST(Spring, PullsAlongAndAcrossItsNormal3D) {
  expect_spring_pulls<3>();
}

// A spring's end moves as the body does where it is: in a body whose velocity grows linearly along an axis from 0 at
// its middle, by the velocity at the end times dt. The end is half a cell from two nodes, whose velocities differ by
// twice its own; those near the body's faces are a little off.
template <int Dim>
void expect_spring_rides_where_its_end_is() {
  constexpr int axis = Dim - 2;
  Vec<Dim> other = Vec<Dim>::Zero();
  other[0] = 6;
  std::vector<Body<Dim>> bodies{block_at<Dim>(Vec<Dim>::Zero()), block_at<Dim>(other)};
  std::array<int, Dim> place{};
  place.fill(1);
  place[axis] = 3;
  const auto particle = static_cast<int>(bodies[1].lattice.point(place));
  Vec<Dim> offset = Vec<Dim>::Zero();
  offset[axis] =
      0.86 + other[axis] - bodies[1].points.x[static_cast<std::size_t>(particle)][axis];  // nodes at .61, 1.11
  const double rate = 4, middle = other[axis] + 0.61;                                     // 1/s, mm
  for (std::size_t p = 0; p < bodies[1].points.x.size(); ++p)
    bodies[1].points.v[p][Dim - 1] = rate * (bodies[1].points.x[p][axis] - middle);
  Engine<Dim> engine(bodies, open_grid<Dim>(), {});
  const double area = 0.7, k = 20;
  engine.set_springs({{{0, 3, Vec<Dim>::Zero()}, {1, particle, offset}, Vec<Dim>::Unit(0), area, k, k}});
  engine.step();
  const double jump = engine.state().time_step_s * rate * 0.25;
  EXPECT_NEAR(std::sqrt(engine.spring_energy() / (0.5 * area * k)) / jump, 1, 0.1);
}

TEST(Spring, RidesWhereItsEndIs2D) {
  expect_spring_rides_where_its_end_is<2>();
}
TEST(Spring, RidesWhereItsEndIs3D) {
  expect_spring_rides_where_its_end_is<3>();
}

}  // namespace
}  // namespace strandlab::mpm
