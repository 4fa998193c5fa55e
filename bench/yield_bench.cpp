// What yielding costs: a block of particles that all yield, pressed uniformly through the thickness, by either law.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "strandlab/mpm/engine.hpp"

namespace {

using namespace strandlab;

constexpr double kCell = 0.8 / 3;
constexpr int kAlong = 200, kThrough = 48;
constexpr int kSteps = 4, kRepeats = 200;  // short ones, the best counts: other work on the machine does not

Strand<2> block(const wood::StrandMaterial& material) {
  const Lattice<2> lattice{{kAlong, kThrough}, Vec<2>::Constant(kCell / 2)};
  return formed_strand<2>(lattice, {}, material);
}

// ns per particle-step of the material update alone, for steps of the given strain (the main job's are about 1e-5).
double cost(const wood::Material& wood, double angle_deg, double strain, double& yielding) {
  const auto body = mpm::body_of(block(wood::in_strand_axes(wood, angle_deg)));
  mpm::Grid<2> grid;
  grid.cell = Vec<2>::Constant(kCell);
  grid.origin = Vec<2>::Zero();
  grid.lo = Vec<2>::Constant(-5);
  grid.hi = Vec<2>::Constant(60);
  mpm::Options options;
  options.timed = true;
  mpm::Engine<2> engine({body}, grid, options);
  const auto press = [&](double rate) { engine.impose(1, [rate](const Vec<2>& x) { return Vec<2>(0, rate * x[1]); }); };
  engine.step();  // at rest: sets the clock
  for (int i = 0; i < 40; ++i) press(-0.005);
  double best = 1e300;
  for (int r = 0; r < kRepeats; ++r) {
    const double before = engine.timing().phases.material;
    for (int i = 0; i < kSteps; ++i) press(-strain);
    const double ns =
        1e9 * (engine.timing().phases.material - before) / (static_cast<double>(engine.particles()) * kSteps);
    best = std::min(best, ns);
  }
  yielding = engine.timing().plastic_fraction;
  return best;
}

}  // namespace

int main() {
  using namespace strandlab;
  fmt::print("material update, ns per particle-step, one thread, every particle yields\n");
  fmt::print("{:<22}{:>14}{:>10}{:>10}{:>10}{:>10}\n", "stress components", "strain/step", "elastic", "Hill",
             "crushing", "ratio");
  for (const double angle : {0.0, 30.0}) {
    for (const double strain : {1e-5, 1e-4}) {
      wood::Material wood = wood::library()[0], crushes = wood, elastic = wood;
      elastic.hill.Y_R = elastic.hill.Y_T = elastic.hill.S_RT = 1e6;  // MPa: never reached
      crushes.law = wood::Law::kCrushing;
      double none = 0, all = 0, crushed = 0;
      const double e = cost(elastic, angle, strain, none), h = cost(wood, angle, strain, all),
                   c = cost(crushes, angle, strain, crushed);
      fmt::print("{:<22}{:>14}{:>10.1f}{:>10.1f}{:>10.1f}{:>10.2f}   ({:.0f}, {:.0f} and {:.0f} % yielding)\n",
                 angle == 0 ? "4 (aligned)" : "6 (at 30 degrees)", strain, e, h, c, c / h, 100 * none, 100 * all,
                 100 * crushed);
    }
  }
}
