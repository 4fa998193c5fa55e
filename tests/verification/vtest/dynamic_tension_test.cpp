// Tension of a whole mat by the explicit engine, the glue points as springs between the strands, against the static
// solution. The two share the wood's constants and the glue points, nothing else: particles on a background grid that
// come to rest in the one, finite elements and a factorised stiffness matrix in the other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "strandlab/mpm/engine.hpp"
#include "support/report.hpp"
#include "verification/vtest/reference_panels.hpp"

namespace strandlab::vtest {
namespace {

constexpr double kStrain = 1e-4;
constexpr double kCompliance_n = 1e-4;  // mm/MPa; 1/D_n of both solutions
// Six particles through a strand, 0.25 mm apart along it; cells of two by two of them.
constexpr double kAlong = 0.25, kCellX = 0.5, kCellY = 1.6 / 6;  // mm
constexpr double kApart = 4 * kCellY;                            // mm, between rows of strands

Panel<2> unyielding_panel(const mat::Mat& mat) {
  auto kinds = kinds_of_poplar();
  for (auto& kind : kinds) kind.material.hill.Y_R = kind.material.hill.Y_T = kind.material.hill.S_RT = 1e6;
  return make_panel(mat, kinds, kAlong, 6);
}

// All of the panel stretched by the same strain along it. Its rows are drawn apart: only the springs join them, no
// contact. In small displacements that changes nothing else.
std::vector<mpm::Body<2>> stretched_bodies(const Panel<2>& panel) {
  std::vector<mpm::Body<2>> bodies;
  for (const auto& strand : panel.strands) {
    auto body = mpm::body_of(strand);
    const Voigt stress = strand.material.stiffness.col(0) * kStrain;
    for (std::size_t p = 0; p < body.points.size(); ++p) {
      body.points.x[p][0] *= 1 + kStrain;
      body.points.x[p][1] += strand.row * kApart;
      body.points.F[p](0, 0) *= 1 + kStrain;
      body.points.stress[p] = stress;
    }
    bodies.push_back(std::move(body));
  }
  return bodies;
}

// Rollers at both ends of the stretched panel, nothing above and below.
mpm::Grid<2> grid_for(const Panel<2>& panel) {
  mpm::Grid<2> grid;
  grid.cell = {kCellX * (1 + kStrain), kCellY};
  grid.origin = {0, panel.bottom_mm};
  grid.lo = {0, panel.bottom_mm - 1};
  grid.hi = {panel.length_mm * (1 + kStrain), panel.top_mm + panel.strands.back().row * kApart + 1};
  grid.sides[0] = {mpm::Side::kRoller, mpm::Side::kRoller};
  return grid;
}

mpm::Spring<2>::End end_of(const Panel<2>& panel, const glue::FacePoint<2>& point) {
  const auto& strand = panel.strands[point.strand];
  const bool top = point.face == glue::StrandFace::kTop;
  const auto& lattice = strand.lattice;
  const auto particle = lattice.point({point.segment, top ? lattice.counts[1] - 1 : 0});
  return {point.strand, static_cast<int>(particle),
          Vec<2>((point.xi - 0.5) * lattice.spacing[0], (top ? 0.5 : -0.5) * lattice.spacing[1])};
}

std::vector<mpm::Spring<2>> springs_of(const Panel<2>& panel, double compliance_t) {
  std::vector<mpm::Spring<2>> springs;
  for (const auto& g : glue::cure(panel, {})) {
    springs.push_back({end_of(panel, g.a), end_of(panel, g.b), g.normal, g.area, 1 / compliance_t, 1 / kCompliance_n});
  }
  return springs;
}

// Modulus by dynamic relaxation, from the stored energy at rest: twice it per volume and squared strain. A drag on all
// motion is critical for about the slowest mode, bending of the panel over its length: alpha = 2 omega.
double dynamic_modulus(const Panel<2>& panel, double compliance_t) {
  mpm::Options options;
  options.friction = 0;
  mpm::Engine<2> engine(stretched_bodies(panel), grid_for(panel), options);
  engine.set_springs(springs_of(panel, compliance_t));
  const double to_modulus = 2 / (kStrain * kStrain * panel.length_mm * panel.thickness_mm());
  const double transit = panel.length_mm / std::sqrt(wood::library()[0].E_L / panel.strands[0].material.density);
  const double drag = 0.25 / transit;
  double before = 0, change = 1, kinetic = 1;
  while (change > 1e-4 || kinetic > 1e-5) {
    const double until = engine.state().time_s + 5 * transit;
    while (engine.state().time_s < until) {
      engine.step();
      engine.scale_velocities(1 - drag * engine.state().time_step_s);
    }
    const auto e = engine.energies();
    const double stored = e.elastic + engine.spring_energy();
    change = std::abs(before / stored - 1);
    kinetic = e.kinetic / stored;
    before = stored;
  }
  return before * to_modulus;
}

// Both with the same normal stiffness of the glue; measured with it rigid, the static moduli are 0.2 % higher.
TEST(Dynamics, TensionOfAMatAgreesWithStaticsNightly) {
  const auto panel = unyielding_panel(reference_mat("osb_s1"));
  Options statics;
  statics.kinds = {TestKind::kTension};
  statics.compliance_t_mm_per_MPa = {1e-4, 0.0105};
  statics.compliance_n_mm_per_MPa = kCompliance_n;
  const auto result = measure(panel, statics);
  for (const double compliance : statics.compliance_t_mm_per_MPa) {
    const double tolerance = compliance < 1e-3 ? 0.02 : 0.01;
    const double ratio = dynamic_modulus(panel, compliance) / find(result, TestKind::kTension, compliance).modulus_MPa;
    report(fmt::format("osb_s1 in tension by explicit dynamics over statics, 1/D_t = {}", compliance), ratio,
           near(1, tolerance));
  }
}

}  // namespace
}  // namespace strandlab::vtest
