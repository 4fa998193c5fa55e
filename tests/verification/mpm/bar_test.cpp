// Axial waves in an elastic bar at small amplitude. With a Poisson ratio of zero the bar is one-dimensional in a
// section as well: wave speed c = sqrt(E/rho), first mode between fixed or free ends of period 2 L/c.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/report.hpp"
#include "verification/mpm/single_block.hpp"

namespace strandlab::mpm {
namespace {

constexpr double kLength = 40;    // mm
constexpr double kStrain = 1e-5;  // amplitude
enum class Ends { kRoller, kFree };

double wave_speed(const wood::StrandMaterial& m) {
  return std::sqrt(m.stiffness(0, 0) / m.density);
}

// `cells` along the bar and 2 through it, two particles per cell and axis, ends on grid lines.
struct Bar {
  std::vector<Body<2>> bodies;
  Grid<2> grid;
  Bar(int cells, const std::array<Side, 2>& sides) {
    const double h = kLength / cells;
    bodies.push_back(block<2>(isotropic(10000, 0, 500), {2 * cells, 4}, {h / 2, h / 2}, {0, 0}));
    grid.cell = {h, h};
    grid.origin = {0, 0};
    grid.lo = {0, 0};
    grid.hi = {kLength, 2 * h};
    grid.sides[0] = sides;
  }
};

double shape(Ends ends, double x) {
  return ends == Ends::kRoller ? std::sin(M_PI * x / kLength) : std::cos(M_PI * x / kLength);
}

struct Vibration {
  double period_error = 0;  // relative
  double energy_drift = 0;  // of the total: its mean over the last period against that over the first
};

// Ten periods of the first mode, started with a velocity at rest. The period comes from the zero crossings of the
// velocity's projection on the mode.
Vibration vibrate(int cells, Ends ends) {
  const Side side = ends == Ends::kRoller ? Side::kRoller : Side::kFree;
  Bar bar(cells, {side, side});
  auto& body = bar.bodies[0];
  const double c = wave_speed(body.material);
  const auto start = body.points.x;
  for (std::size_t p = 0; p < body.points.size(); ++p)
    body.points.v[p][0] = kStrain * c * shape(ends, body.points.x[p][0]);
  Engine<2> engine(bar.bodies, bar.grid, {});
  const double exact = 2 * kLength / c;
  const auto total = [&] {
    const Energies e = engine.energies();
    return e.kinetic + e.elastic;
  };
  const auto amplitude = [&] {
    engine.write(bar.bodies);
    double sum = 0;
    for (std::size_t p = 0; p < start.size(); ++p) sum += body.points.v[p][0] * shape(ends, start[p][0]);
    return sum;
  };
  Vibration result;
  std::vector<double> crossings;  // downwards: one per period
  // Velocities are half a step behind positions, so that the sum of the energies swings by half a step's phase twice
  // per period; its mean over a period does not.
  std::vector<double> sum, samples;
  double before = amplitude();
  while (crossings.size() < 11) {
    engine.step();
    const double now = amplitude(), t = engine.state().time_s, dt = engine.state().time_step_s;
    if (before > 0 && now <= 0) {
      crossings.push_back(t - dt * now / (now - before));
      sum.push_back(0);
      samples.push_back(0);
    }
    before = now;
    if (sum.empty()) continue;
    sum.back() += total();
    ++samples.back();
  }
  result.energy_drift = (sum[9] / samples[9]) / (sum[0] / samples[0]) - 1;
  result.period_error = (crossings.back() - crossings.front()) / 10 / exact - 1;
  return result;
}

void expect_second_order(Ends ends, const char* name) {
  std::vector<Vibration> runs;
  for (int cells : {10, 20, 40, 80}) {
    runs.push_back(vibrate(cells, ends));
    // 1.7 (h/L)^2, within a factor of two.
    report(fmt::format("bar with {} ends, {} cells: relative error of the period 2 L/c", name, cells),
           runs.back().period_error, within(2.5 / (cells * cells)));
    if (cells < 40) continue;
    report(fmt::format("bar with {} ends, {} cells: energy drift over ten periods", name, cells),
           runs.back().energy_drift, within(cells == 40 ? 5e-3 : 1e-3));
  }
  const double order = std::log2(std::abs(runs[0].period_error / runs[3].period_error)) / 3;
  report(fmt::format("bar with {} ends: order of the period's error, 10 to 80 cells", name), order, above(1.8));
}

TEST(Bar, PeriodBetweenRollers) {
  expect_second_order(Ends::kRoller, "roller");
}
TEST(Bar, PeriodBetweenFreeEnds) {
  expect_second_order(Ends::kFree, "free");
}

// A bar that flies into a wall (the roller) sends a front to its free end, which it reaches at L/c: behind the front
// the bar is at rest, and the free end flies back as fast as it came. A grid spreads the front into the integral of an
// Airy function, which has risen to 1/3 where the sharp front would be; the free end then moves at -1/3 of its speed.
TEST(Bar, WaveTransit) {
  constexpr int kCells = 100;
  Bar bar(kCells, {Side::kRoller, Side::kFree});
  auto& body = bar.bodies[0];
  const double c = wave_speed(body.material), speed = kStrain * c;
  for (auto& v : body.points.v) v[0] = -speed;
  Engine<2> engine(bar.bodies, bar.grid, {});
  const std::size_t end = 2 * kCells - 1;
  double before = -speed, arrival = 0;
  while (arrival == 0 && engine.state().time_s < 2 * kLength / c) {
    engine.step();
    engine.write(bar.bodies);
    const double now = body.points.v[end][0], dt = engine.state().time_step_s;
    if (now >= -speed / 3) arrival = engine.state().time_s - dt * (now + speed / 3) / (now - before);
    before = now;
  }
  report("bar: arrival of a wave at the free end over L/c", arrival * c / kLength, near(1, 0.005));
}

// A roller is a plane of symmetry: half a block that slides along it moves as the half of a whole block of which both
// halves are each other's image. Points are stretched, so that those at the plane reach behind it: what falls there
// counts with its sign.
TEST(Roller, IsAPlaneOfSymmetry) {
  // So slow that the length of a step, which is found from some of the points, is that of both to as many digits.
  constexpr double kCell = 1, kSpeed = 1e-3;  // mm, 1/s
  constexpr int kHalf = 8, kThrough = 6, kSteps = 200;
  const auto start = [&](Body<2>& body) {
    for (std::size_t p = 0; p < body.points.size(); ++p) {
      const double x = body.points.x[p][0], y = body.points.x[p][1];
      body.points.F[p](0, 0) = 1.4;
      body.points.v[p] = kSpeed * Vec<2>(2 * x * (1 + .3 * y), std::cos(x) * y);
    }
  };
  std::vector<Body<2>> whole{
      block<2>(elastic_poplar(0), {2 * kHalf, kThrough}, {kCell / 2, kCell / 2}, {-kHalf * kCell / 2, 0})};
  std::vector<Body<2>> half{block<2>(elastic_poplar(0), {kHalf, kThrough}, {kCell / 2, kCell / 2}, {0, 0})};
  start(whole[0]);
  start(half[0]);
  auto grid = open_grid<2>(kCell, -20, 20);
  Engine<2> of_whole(whole, grid, {});
  grid.lo[0] = 0;
  grid.sides[0] = {Side::kRoller, Side::kFree};
  Engine<2> of_half(half, grid, {});
  for (int n = 0; n < kSteps; ++n) {
    of_whole.step();
    of_half.step();
  }
  of_whole.write(whole);
  of_half.write(half);
  double worst = 0, moved = 0;
  for (std::size_t p = 0; p < half[0].points.size(); ++p) {
    auto index = half[0].lattice.place_of_point(p);
    const Vec<2> x = half[0].points.x[p];
    index[0] += kHalf;
    worst = std::max(worst, (x - whole[0].points.x[whole[0].lattice.point(index)]).norm());
    index[0] -= kHalf;
    moved = std::max(moved, (x - kCell / 2 * Vec<2>(index[0] + .5, index[1] + .5)).norm());
  }
  report("half a block at a roller and the half of a whole one: distance over the way gone", worst / moved,
         below(2e-6));
}

}  // namespace
}  // namespace strandlab::mpm
