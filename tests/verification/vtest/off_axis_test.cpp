// Rows at any angle to the panel, without gaps, in tension, against laminate theory: every row stretches alike, is free
// through the thickness and does not strain across.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/report.hpp"
#include "verification/vtest/reference_panels.hpp"

namespace strandlab::vtest {
namespace {

constexpr const char* kAsPrinted = "the expected number has five digits";
constexpr const char* kSolve = "round-off of the solution of the equations";

// One full row per angle.
Panel<2> laminate(const std::vector<double>& angles_deg, wood::OffAxis off_axis) {
  std::vector<StrandKind> kinds;
  mat::Mat mat;
  mat.length_mm = 20;
  mat.layer_thickness_mm = 0.8;
  for (const double angle : angles_deg) {
    const auto name = fmt::format("row at {}", angle);
    kinds.push_back({name, wood::Material(), angle, 1, 1, off_axis});
    mat::Layer layer;
    layer.role = name;
    mat::Strand strand;
    strand.x1_mm = mat.length_mm;
    layer.strands.push_back(strand);
    mat.layers.push_back(layer);
  }
  return make_panel(mat, kinds, 0.8 / 3, 6);
}

double measured_modulus(const std::vector<double>& angles_deg, wood::OffAxis off_axis) {
  Options options;
  options.compliance_t_mm_per_MPa = {0};
  return find(measure(laminate(angles_deg, off_axis), options), TestKind::kTension, 0).modulus_MPa;
}

struct Turn {
  double c2, s2;
  explicit Turn(double angle_deg) {
    const double c = std::cos(angle_deg * M_PI / 180);
    c2 = c * c;
    s2 = 1 - c2;
  }
};

// Neither strain nor shear across: Q11 of the lamina in plane stress, turned (Jones, Mechanics of Composite Materials,
// Eq. 2.85): c^4 Q_LL + s^4 Q_TT + 2 (Q_LT + 2 G_TL) s^2 c^2.
double exact_row(double angle_deg) {
  const wood::Material m;
  const Turn t(angle_deg);
  const double shrink = 1 - m.nu_TL * m.nu_TL * m.E_L / m.E_T;
  const double Q_LL = m.E_L / shrink, Q_TT = m.E_T / shrink, Q_LT = m.nu_TL * Q_LL;
  return t.c2 * t.c2 * Q_LL + t.s2 * t.s2 * Q_TT + 2 * (Q_LT + 2 * m.G_TL) * t.s2 * t.c2;
}

// No strain across and no shear stress: 1/(S11 - S12^2/S22) of the turned compliance (Jones, Eq. 2.88).
double uncoupled_row(double angle_deg) {
  const wood::Material m;
  const Turn t(angle_deg);
  const double S_LL = 1 / m.E_L, S_TT = 1 / m.E_T, S_LT = -m.nu_TL / m.E_T, S_shear = 1 / m.G_TL;
  const double cross = (2 * S_LT + S_shear) * t.s2 * t.c2;
  const double S11 = S_LL * t.c2 * t.c2 + cross + S_TT * t.s2 * t.s2;
  const double S22 = S_LL * t.s2 * t.s2 + cross + S_TT * t.c2 * t.c2;
  const double S12 = S_LT * (t.s2 * t.s2 + t.c2 * t.c2) + (S_LL + S_TT - S_shear) * t.s2 * t.c2;
  return 1 / (S11 - S12 * S12 / S22);
}

double mean(const std::vector<double>& angles_deg, double (*row)(double)) {
  double sum = 0;
  for (const double angle : angles_deg) sum += row(angle);
  return sum / static_cast<double>(angles_deg.size());
}

// 10003.3, 3379.3 and 429.9 MPa at 0, 45 and 90 degrees; rows [0/45/-45/90] have the mean over all angles.
TEST(OffAxisRows, QuasiIsotropicLaminateIsTheMeanOverAngles) {
  const std::vector<double> angles{0, 45, -45, 90};
  EXPECT_NEAR(mean(angles, exact_row), 4297.9, 0.06);
  const double exact = measured_modulus(angles, wood::OffAxis::kExact);
  report("rows [0/45/-45/90] in tension, exact", exact, near(4297.9, 0.06).because(kAsPrinted), "MPa");
  // Free to shear across, by hand: (10003.3 + 2 x 1109.1 + 429.9)/4.
  const double uncoupled = measured_modulus(angles, wood::OffAxis::kUncoupled);
  report("rows [0/45/-45/90] in tension, uncoupled", uncoupled, near(mean(angles, uncoupled_row), 1e-3).because(kSolve),
         "MPa");
}

// One row alone: the table of docs/theory.md.
TEST(OffAxisRows, EachAngleAsATableHasIt) {
  struct Line {
    double angle_deg, exact, uncoupled;  // MPa
  };
  for (const auto& line : std::vector<Line>{{0, 10003.3, 10003.3},
                                            {15, 8902.7, 5437.3},
                                            {30, 6232.0, 2246.0},
                                            {45, 3379.3, 1109.2},
                                            {60, 1445.3, 655.0},
                                            {75, 611.9, 471.4},
                                            {90, 429.9, 429.9}}) {
    EXPECT_NEAR(measured_modulus({line.angle_deg}, wood::OffAxis::kExact), line.exact, 0.06) << line.angle_deg;
    EXPECT_NEAR(measured_modulus({line.angle_deg}, wood::OffAxis::kUncoupled), line.uncoupled, 0.06) << line.angle_deg;
  }
  std::vector<double> all;
  for (int i = 0; i < 3600; ++i) all.push_back(180.0 * i / 3600);
  report("mean over all angles of a row's modulus, exact, by the closed form", mean(all, exact_row),
         near(4297.9, 0.06).because(kAsPrinted), "MPa");
  report("mean over all angles of a row's modulus, uncoupled, by the closed form", mean(all, uncoupled_row),
         near(2516.9, 0.06).because(kAsPrinted), "MPa");
}

TEST(OffAxisRows, LaminateOfManyAnglesFollowsLaminateTheory) {
  const std::vector<double> angles{0, 17, -33, 62, -75, 90, 8, -45};
  for (const auto off_axis : {wood::OffAxis::kExact, wood::OffAxis::kUncoupled}) {
    const double expected = mean(angles, off_axis == wood::OffAxis::kExact ? exact_row : uncoupled_row);
    const double ratio = measured_modulus(angles, off_axis) / expected;
    report(fmt::format("laminate of eight angles in tension, {}, over laminate theory", wood::name(off_axis)), ratio,
           near(1, 1e-6).because(kSolve));
  }
}

}  // namespace
}  // namespace strandlab::vtest
