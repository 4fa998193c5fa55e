// Strands whose grain lies off the section carry six stress components in two dimensions, and strands that yield do it
// in the engine's packs as one point does by itself.
#include <gtest/gtest.h>

#include <cmath>

#include "strandlab/wood/yield_modes.hpp"
#include "support/report.hpp"
#include "verification/mpm/single_block.hpp"

namespace strandlab::mpm {
namespace {

constexpr double kCell = 0.5;

wood::StrandMaterial poplar(wood::Law law, double angle_deg, bool densified = false) {
  wood::Material m = wood::library()[densified ? 1 : 0];
  m.law = law;
  return wood::in_strand_axes(m, angle_deg);
}

// A block strained uniformly by `steps` steps of the velocity gradient L at 1 s each.
Body<2> strained(const wood::StrandMaterial& material, const Tensor<2>& L, int steps) {
  std::vector<Body<2>> bodies{block<2>(material, {8, 8}, {kCell / 2, kCell / 2}, Vec<2>::Zero())};
  bodies[0].points.plastic.assign(bodies[0].points.size(), material.start());
  Engine<2> engine(bodies, open_grid<2>(kCell, -4, 8), {});
  for (int i = 0; i < steps; ++i) engine.impose(1, [&](const Vec<2>& x) { return Vec<2>(L * x); });
  engine.write(bodies);
  return bodies[0];
}

// Strains of 1e-6 of the section in every direction: the stress is stiffness x strain, 23 and 12 included.
TEST(OffAxisStrand, FeelsTheFullStiffness) {
  double worst = 0;
  for (const double angle : {-60.0, 20.0, 45.0}) {
    const auto material = elastic_poplar(angle);
    ASSERT_TRUE(wood::needs_six(material));
    Tensor<2> L;
    L << 1e-6, 0.7e-6, 0.2e-6, -0.6e-6;
    const auto body = strained(material, L, 1);
    Voigt strain;
    strain << L(0, 0), 0, L(1, 1), 0, L(0, 1) + L(1, 0), 0;
    const Voigt expected = material.stiffness * strain;
    EXPECT_GT(std::abs(expected[5]), 0.1 * std::abs(expected[0])) << "no shear across to speak of";
    for (const auto& stress : body.points.stress) {
      worst = std::max(worst, (stress - expected).norm() / expected.norm());
    }
  }
  report("off-axis block under small strain, all six stresses against the wood's stiffness", worst, below(5e-7));
}

// One point under the same steps: compression through the thickness by strains `a`, F as the engine integrates it.
template <class Yielding, int N>
void follow(const wood::StrandMaterial& material, double a, int steps, double (&tau)[N], double& history) {
  const auto modes = wood::yield_modes<N>(material);
  double J = 1;
  history = material.start();
  double radius = Yielding::template radius<wood::ScalarOps>(wood::part_of<Yielding>(modes.laws), history);
  for (int i = 0; i < steps; ++i) {
    J *= 1 + a + 0.5 * a * a;
    for (int k = 0; k < N; ++k) tau[k] += modes.stiffness[k][2] * a;
    wood::return_map<Yielding, wood::ScalarOps, N>(modes, tau, J, history, radius);
  }
}

template <class Yielding, int N>
double difference(const wood::StrandMaterial& material, double a, int steps) {
  Tensor<2> L = Tensor<2>::Zero();
  L(1, 1) = a;
  const auto body = strained(material, L, steps);
  double tau[N] = {}, history = 0, worst = 0, size = 0;
  follow<Yielding, N>(material, a, steps, tau, history);
  EXPECT_GT(history, material.start());
  for (int k = 0; k < N; ++k) size = std::max(size, std::abs(tau[k]));
  for (std::size_t p = 0; p < body.points.size(); ++p) {
    for (int k = 0; k < N; ++k) {
      worst = std::max(worst, std::abs(body.points.stress[p][wood::kModeToVoigt[k]] - tau[k]) / size);
    }
    EXPECT_NEAR(body.points.plastic[p], history, 1e-9);
  }
  return worst;
}

TEST(Packs, YieldAsOnePointDoes) {
  using enum wood::Law;
  double worst = 0;
  for (const double a : {-1e-4, -0.002}) {
    const int steps = static_cast<int>(std::lround(-0.6 / a / 4));  // to a strain of .15
    worst = std::max(worst, difference<wood::Hill, 4>(poplar(kHill, 0), a, steps));
    worst = std::max(worst, difference<wood::Hill, 6>(poplar(kHill, 30), a, steps));
    worst = std::max(worst, difference<wood::Crushing, 4>(poplar(kCrushing, 0), a, 4 * steps));
    worst = std::max(worst, difference<wood::Crushing, 6>(poplar(kCrushing, 30), a, 4 * steps));
    worst = std::max(worst, difference<wood::Crushing, 4>(poplar(kCrushing, 90, true), a, steps));
  }
  report("packs of eight against one point, both laws, compression to 14 and 45 %: stress", worst,
         below(1e-11).because(test::kRoundOff));
}

}  // namespace
}  // namespace strandlab::mpm
