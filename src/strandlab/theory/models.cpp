#include "strandlab/theory/models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "strandlab/core/error.hpp"

namespace strandlab::theory {
namespace {

constexpr double kPi = 3.14159265358979323846;

double square(double x) {
  return x * x;
}

double nu_LT(const wood::Material& m) {
  return m.nu_TL * m.E_L / m.E_T;
}

// Mean of a smooth function of the grain angle with period 180 degrees: equally spaced angles converge exponentially.
template <typename Function>
double angle_average(const Function& value) {
  constexpr int kAngles = 720;
  double sum = 0;
  for (int i = 0; i < kAngles; ++i) sum += value(180.0 * i / kAngles - 90);
  return sum / kAngles;
}

// Mean over angles uniform within angle +- spread, by the middles of intervals of a quarter degree at most; over +-90
// degrees they are equally spaced over the period too.
template <typename Function>
double mean_within(double angle, double spread, const Function& value) {
  if (!(spread > 0)) return value(angle);
  constexpr int kAngles = 720;
  double sum = 0;
  for (int i = 0; i < kAngles; ++i) sum += value(angle + spread * ((2 * i + 1.0) / kAngles - 1));
  return sum / kAngles;
}

// Mean over normal angles: equally spaced ones to 7 standard deviations, by their density.
template <typename Function>
double normal_mean(double angle, double sd, const Function& value) {
  constexpr int kAngles = 360;
  double sum = 0, weights = 0;
  for (int i = 0; i <= kAngles; ++i) {
    const double deviation = 7 * (2.0 * i / kAngles - 1), weight = std::exp(-0.5 * square(deviation));
    sum += weight * value(angle + sd * deviation);
    weights += weight;
  }
  return sum / weights;
}

// Mean of value(material, angle) over the wood of a row.
template <typename Function>
double mean_over(const Row& row, const Function& value) {
  if (row.pieces.empty()) {
    const auto at = [&](double angle) { return value(row.material, angle); };
    return row.angle_sd_deg > 0 ? normal_mean(row.angle_deg, row.angle_sd_deg, at)
                                : mean_within(row.angle_deg, row.angle_spread_deg, at);
  }
  double sum = 0, wood = 0;
  for (const Piece& piece : row.pieces) {
    sum += piece.length_mm * value(piece.material, piece.angle_deg);
    wood += piece.length_mm;
  }
  return sum / wood;
}

double off_grain(double angle_deg) {
  return std::abs(std::remainder(angle_deg, 180.0));
}

void check_compaction(double compaction) {
  if (!(compaction >= 0) || !(compaction < 1))
    throw InputError(fmt::format("compaction {:g} is not in 0 <= C < 1", compaction));
}

void check_rows(std::size_t rows) {
  if (rows == 0) throw InputError("a panel needs at least one row of strands");
}

std::vector<double> row_moduli(const std::vector<Row>& rows, OffAxis off_axis) {
  std::vector<double> moduli;
  moduli.reserve(rows.size());
  for (const Row& row : rows) moduli.push_back(strand_modulus_MPa(row, off_axis) * solid_fraction(row.statistics));
  return moduli;
}

std::vector<double> thicknesses(const std::vector<Row>& rows) {
  std::vector<double> mm(rows.size());
  std::transform(rows.begin(), rows.end(), mm.begin(), [](const Row& row) { return row.thickness_mm; });
  return mm;
}

std::vector<double> or_equal(const std::vector<double>& thicknesses_mm, std::size_t rows) {
  return thicknesses_mm.empty() ? std::vector<double>(rows, 1.0) : thicknesses_mm;
}

}  // namespace

double solid_fraction(const mat::StrandStatistics& s) {
  return s.gap_mm > 0 ? s.length_mm / (s.length_mm + s.gap_mm) : 1;
}

bool runs_along(const Row& row) {
  if (row.pieces.empty()) return off_grain(row.angle_deg) + row.angle_spread_deg + row.angle_sd_deg < 45;
  return std::all_of(row.pieces.begin(), row.pieces.end(),
                     [](const Piece& piece) { return off_grain(piece.angle_deg) < 45; });
}

double off_axis_modulus_MPa(const wood::Material& m, double angle_deg) {
  const double c2 = square(std::cos(angle_deg * kPi / 180)), s2 = 1 - c2;
  return 1 / (square(c2) / m.E_L + (1 / m.G_TL - 2 * nu_LT(m) / m.E_L) * s2 * c2 + square(s2) / m.E_T);
}

double plane_strain_modulus_MPa(const wood::Material& material, double angle_deg) {
  const VoigtMatrix C = wood::in_strand_axes(material, angle_deg).stiffness;
  return C(0, 0) - square(C(0, 2)) / C(2, 2);
}

double off_axis_average_MPa(const wood::Material& material) {
  return angle_average([&](double angle) { return off_axis_modulus_MPa(material, angle); });
}

double plane_strain_average_MPa(const wood::Material& material) {
  return angle_average([&](double angle) { return plane_strain_modulus_MPa(material, angle); });
}

double quasi_isotropic_modulus_MPa(const wood::Material& m) {
  const double shrink = 1 - nu_LT(m) * m.nu_TL;
  const double Q11 = m.E_L / shrink, Q22 = m.E_T / shrink, Q12 = m.nu_TL * m.E_L / shrink, Q66 = m.G_TL;
  const double U1 = (3 * Q11 + 3 * Q22 + 2 * Q12 + 4 * Q66) / 8, U4 = (Q11 + Q22 + 6 * Q12 - 4 * Q66) / 8;
  return (square(U1) - square(U4)) / U1;
}

double strand_modulus_MPa(const Row& row, OffAxis off_axis) {
  return mean_over(row, [&](const wood::Material& material, double angle) {
    return off_axis == OffAxis::kExact ? plane_strain_modulus_MPa(material, angle)
                                       : off_axis_modulus_MPa(material, angle);
  });
}

double tension_of_moduli_MPa(const std::vector<double>& moduli, double compaction,
                             const std::vector<double>& thicknesses_mm) {
  check_compaction(compaction);
  check_rows(moduli.size());
  const auto t = or_equal(thicknesses_mm, moduli.size());
  return std::inner_product(moduli.begin(), moduli.end(), t.begin(), 0.0) / std::accumulate(t.begin(), t.end(), 0.0) /
         (1 - compaction);
}

double bending_of_moduli_MPa(const std::vector<double>& moduli, double compaction,
                             const std::vector<double>& thicknesses_mm) {
  check_compaction(compaction);
  check_rows(moduli.size());
  const auto t = or_equal(thicknesses_mm, moduli.size());
  // About the neutral axis, which an unsymmetrical layup moves off the middle.
  double height = 0, stretch = 0, moment = 0, stiffness = 0;
  for (std::size_t i = 0; i < moduli.size(); ++i) {
    const double y = height + 0.5 * t[i];
    stretch += moduli[i] * t[i];
    moment += moduli[i] * t[i] * y;
    stiffness += moduli[i] * t[i] * (square(t[i]) / 12 + square(y));
    height += t[i];
  }
  return (stiffness - square(moment) / stretch) / (height * height * height / 12) / (1 - compaction);
}

double tension_modulus_MPa(const std::vector<Row>& rows, double compaction, OffAxis off_axis) {
  return tension_of_moduli_MPa(row_moduli(rows, off_axis), compaction, thicknesses(rows));
}

double bending_modulus_MPa(const std::vector<Row>& rows, double compaction, OffAxis off_axis) {
  return bending_of_moduli_MPa(row_moduli(rows, off_axis), compaction, thicknesses(rows));
}

double random_core_modulus_MPa(const std::vector<Row>& rows, double core_modulus, double compaction, OffAxis off_axis) {
  std::vector<double> moduli = row_moduli(rows, off_axis);
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!runs_along(rows[i])) moduli[i] = core_modulus * solid_fraction(rows[i].statistics);
  return tension_of_moduli_MPa(moduli, compaction, thicknesses(rows));
}

double strand_efficiency(const ShearLag& s, double compliance_t) {
  const double V_m = 1 - s.V_w;
  if (!(V_m > 0)) return 1;
  if (!(s.V_w > 0)) return 0;
  const double stiffness = 1 / (s.E_m_MPa * V_m) + 1 / (s.E_w_MPa * s.V_w);
  const double shear = s.V_w / (3 * s.G_w_MPa) + V_m / (3 * s.G_m_MPa) + compliance_t / s.spacing_mm;
  if (!(shear > 0))
    throw InputError(
        fmt::format("glue compliance 1/D_t = {:g} mm/MPa takes away more than the shear compliance of strands "
                    "and matrix; it must be above {:g}",
                    compliance_t, compliance_t - shear * s.spacing_mm));
  const double gamma = std::sqrt(stiffness / shear) * s.length_mm / (2 * s.spacing_mm);
  return gamma > 1e-4 ? 1 - std::tanh(gamma) / gamma : square(gamma) / 3;
}

double shear_lag_modulus_MPa(const ShearLag& s, double compliance_t) {
  return strand_efficiency(s, compliance_t) * s.E_w_MPa * s.V_w + s.E_m_MPa * (1 - s.V_w);
}

double shear_lag_panel_MPa(const std::vector<Row>& rows, const Matrix& matrix, double compliance_t, double compaction,
                           OffAxis off_axis) {
  std::vector<double> moduli = row_moduli(rows, off_axis);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    if (!runs_along(row)) continue;
    const double G_RL = mean_over(row, [](const wood::Material& material, double) { return material.G_RL; });
    moduli[i] =
        shear_lag_modulus_MPa({strand_modulus_MPa(row, off_axis), G_RL, solid_fraction(row.statistics),
                               matrix.modulus_MPa, matrix.shear_MPa, row.statistics.length_mm, row.thickness_mm},
                              compliance_t);
  }
  return tension_of_moduli_MPa(moduli, compaction, thicknesses(rows));
}

double density_kg_m3(const std::vector<Row>& rows, double compaction) {
  check_compaction(compaction);
  check_rows(rows.size());
  double mass = 0, height = 0;
  for (const Row& row : rows) {
    const double wood = mean_over(row, [](const wood::Material& material, double) { return material.density_kg_m3; });
    mass += wood * solid_fraction(row.statistics) * row.thickness_mm;
    height += row.thickness_mm;
  }
  return mass / height / (1 - compaction);
}

double modulus_at_density_MPa(const std::vector<Row>& rows, double density, OffAxis off_axis) {
  const double loose = density_kg_m3(rows, 0);
  if (!(density >= loose) || !std::isfinite(density))
    throw InputError(fmt::format("density {:g} kg/m3 is below that of the mat, {:g} kg/m3", density, loose));
  return tension_modulus_MPa(rows, 0, off_axis) / loose * density;
}

}  // namespace strandlab::theory
