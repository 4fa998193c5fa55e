#include "strandlab/wood/material.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "strandlab/core/error.hpp"

namespace strandlab::wood {
namespace {

constexpr double kCellWallDensity = 1500;  // kg/m^3

// Places of the wood axes and of the shears in the Voigt order of a strand at angle 0.
constexpr int kL = 0, kT = 1, kR = 2, kTR = 3, kLR = 4, kLT = 5;

[[noreturn]] void reject(const Material& m, const std::string& what) {
  throw InputError(fmt::format("material \"{}\": {}", m.name, what));
}

void check_signs(const Material& m) {
  const std::array<std::pair<const char*, double>, 7> finite{{{"density_kg_m3", m.density_kg_m3},
                                                              {"E_L", m.E_L},
                                                              {"E_R", m.E_R},
                                                              {"E_T", m.E_T},
                                                              {"G_RL", m.G_RL},
                                                              {"G_TL", m.G_TL},
                                                              {"G_RT", m.G_RT}}};
  for (const auto& [name, value] : finite) {
    if (!(value > 0) || !std::isfinite(value)) {
      reject(m, fmt::format("{} = {} must be a positive finite number", name, value));
    }
  }
}

void check_hill_constants(const Material& m) {
  const std::array<std::pair<const char*, double>, 6> yields{
      {{"Y_L", m.Y_L}, {"Y_R", m.Y_R}, {"Y_T", m.Y_T}, {"S_RT", m.S_RT}, {"S_RL", m.S_RL}, {"S_TL", m.S_TL}}};
  for (const auto& [name, value] : yields) {
    if (!(value > 0)) reject(m, fmt::format("{} = {} must be positive (or infinite: never yields)", name, value));
  }
  if (!std::isfinite(m.Y_R)) reject(m, "Y_R must be finite: it is the scale of the hardening law 1 + (K/Y_R) alpha^n");
  if (!(m.hardening_K >= 0) || !std::isfinite(m.hardening_K)) {
    reject(m, fmt::format("hardening_K = {} must be zero or a positive finite number", m.hardening_K));
  }
  if (!(m.hardening_n >= 1) || !std::isfinite(m.hardening_n)) {
    reject(m, fmt::format(
                  "hardening_n = {} must be a finite number of at least 1 (below, hardening starts infinitely steep)",
                  m.hardening_n));
  }
}

// The compliance is positive definite when the normalised couplings c = nu_ij sqrt(E_j/E_i) satisfy |c| < 1 for each
// pair and 1 - a^2 - b^2 - c^2 - 2 a b c > 0 together. Names the Poisson ratio to change and its range with the others
// kept.
void check_positive_definite(const Material& m) {
  struct Coupling {
    const char* name;
    double nu, scale, c;
  };
  const auto coupling = [](const char* name, double nu, double E_i, double E_j) {
    const double scale = std::sqrt(E_j / E_i);
    return Coupling{name, nu, scale, nu * scale};
  };
  const std::array<Coupling, 3> k{coupling("nu_RL", m.nu_RL, m.E_R, m.E_L), coupling("nu_TL", m.nu_TL, m.E_T, m.E_L),
                                  coupling("nu_TR", m.nu_TR, m.E_T, m.E_R)};
  std::size_t worst = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(std::abs(k[i].c) < 1)) {
      reject(m, fmt::format("compliance is not positive definite: {} = {} must lie between {:.6g} and {:.6g} "
                            "(|nu_ij| < sqrt(E_i/E_j))",
                            k[i].name, k[i].nu, -1 / k[i].scale, 1 / k[i].scale));
    }
    if (std::abs(k[i].c) > std::abs(k[worst].c)) worst = i;
  }
  const double a = k[(worst + 1) % 3].c, b = k[(worst + 2) % 3].c, c = k[worst].c;
  if (1 - a * a - b * b - c * c - 2 * a * b * c > 0) return;
  const double half_range = std::sqrt((1 - a * a) * (1 - b * b));
  reject(m, fmt::format("compliance is not positive definite: with the other Poisson ratios as given, {} = {} must lie "
                        "between {:.6g} and {:.6g}",
                        k[worst].name, k[worst].nu, (-a * b - half_range) / k[worst].scale,
                        (-a * b + half_range) / k[worst].scale));
}

// Hill's form does not see pressure, so it is positive semi-definite when 1/Y_L, 1/Y_R, 1/Y_T can be the sides of a
// triangle.
void check_hill(const Material& m) {
  const double l = 1 / m.Y_L, r = 1 / m.Y_R, t = 1 / m.Y_T;
  const double round_off = 1e-12 * (r + t);
  if (std::abs(r - t) > l + round_off) {
    reject(m, fmt::format("yield surface is not positive semi-definite: Y_R = {}, Y_T = {}, Y_L = {} break the rule "
                          "|1/Y_R - 1/Y_T| <= 1/Y_L (with Y_L infinite, Y_R must equal Y_T)",
                          m.Y_R, m.Y_T, m.Y_L));
  }
  if (l > r + t + round_off) {
    reject(m, fmt::format("yield surface is not positive semi-definite: Y_L = {} breaks the rule "
                          "1/Y_L <= 1/Y_R + 1/Y_T with Y_R = {}, Y_T = {}",
                          m.Y_L, m.Y_R, m.Y_T));
  }
}

void check_crushing(const Material& m) {
  const auto& k = m.crushing;
  const std::array<std::pair<const char*, double>, 6> yields{{{"crushing_Y_L", k.Y_L},
                                                              {"crushing_Y_R", k.Y_R},
                                                              {"crushing_Y_T", k.Y_T},
                                                              {"crushing_S_RT", k.S_RT},
                                                              {"crushing_S_RL", k.S_RL},
                                                              {"crushing_S_TL", k.S_TL}}};
  for (const auto& [name, value] : yields) {
    if (!(value > 0)) reject(m, fmt::format("{} = {} must be positive (or infinite: never yields)", name, value));
  }
  if (!(std::abs(k.c) <= 1)) {
    reject(m,
           fmt::format("yield surface is not positive semi-definite: crushing_c = {} must lie between -1 and 1", k.c));
  }
  for (const auto& [name, value] : {std::pair{"crushing_h1", k.h1}, {"crushing_h2", k.h2}}) {
    if (!(value >= 0) || !std::isfinite(value)) {
      reject(m, fmt::format("{} = {} must be zero or a positive finite number", name, value));
    }
  }
  if (!(k.exponent >= 1) || !std::isfinite(k.exponent)) {
    reject(m, fmt::format("crushing_m = {} must be a finite number of at least 1 (below, hardening starts infinitely "
                          "steep)",
                          k.exponent));
  }
  if (!(k.start >= 0 && k.start < 1))
    reject(m, fmt::format("crushing_start = {} must be from 0 to less than 1", k.start));
  if (!(m.density_kg_m3 < kCellWallDensity)) {
    reject(m, fmt::format("density_kg_m3 = {} leaves nothing to crush: it must be below that of the cell wall, {}",
                          m.density_kg_m3, kCellWallDensity));
  }
}

double inverse_square(double y) {
  return 1 / (y * y);
}

// f^2 = s^T P s in wood axes; F, G, H after Hill (1950). An infinite yield stress leaves a zero.
VoigtMatrix hill_in_wood_axes(const Material& m) {
  const double l = inverse_square(m.Y_L), r = inverse_square(m.Y_R), t = inverse_square(m.Y_T);
  VoigtMatrix P = VoigtMatrix::Zero();
  P(kL, kL) = l;
  P(kR, kR) = r;
  P(kT, kT) = t;
  P(kR, kT) = P(kT, kR) = -0.5 * (r + t - l);
  P(kL, kT) = P(kT, kL) = -0.5 * (l + t - r);
  P(kL, kR) = P(kR, kL) = -0.5 * (l + r - t);
  P(kTR, kTR) = inverse_square(m.S_RT);
  P(kLR, kLR) = inverse_square(m.S_RL);
  P(kLT, kLT) = inverse_square(m.S_TL);
  return P;
}

VoigtMatrix crushing_in_wood_axes(const Crushing& k) {
  VoigtMatrix P = VoigtMatrix::Zero();
  P(kL, kL) = inverse_square(k.Y_L);
  P(kR, kR) = inverse_square(k.Y_R);
  P(kT, kT) = inverse_square(k.Y_T);
  P(kR, kT) = P(kT, kR) = -k.c / (k.Y_R * k.Y_T);
  P(kTR, kTR) = inverse_square(k.S_RT);
  P(kLR, kLR) = inverse_square(k.S_RL);
  P(kLT, kLT) = inverse_square(k.S_TL);
  return P;
}

CrushingHardening crushing_hardening(const Material& m) {
  const auto& k = m.crushing;
  return {1 - m.density_kg_m3 * (1 - k.start) / kCellWallDensity, k.start, k.h1, k.h2, k.exponent};
}

// Cosine and sine, exact at the multiples of 90 degrees so that aligned strands have exact zeros.
std::pair<double, double> cos_sin(double angle_deg) {
  const double turn = std::remainder(angle_deg, 360.0);
  if (turn == 0) return {1.0, 0.0};
  if (turn == 90) return {0.0, 1.0};
  if (turn == -90) return {0.0, -1.0};
  if (std::abs(turn) == 180) return {-1.0, 0.0};
  const double angle = turn * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle)};
}

// Stress in wood axes from stress in strand axes, grain at (c, s) to the strand: s_wood = Q s_strand.
VoigtMatrix stress_to_wood(double c, double s) {
  VoigtMatrix Q = VoigtMatrix::Zero();
  Q(0, 0) = Q(1, 1) = c * c;
  Q(0, 1) = Q(1, 0) = s * s;
  Q(0, 5) = 2 * c * s;
  Q(1, 5) = -2 * c * s;
  Q(5, 0) = -c * s;
  Q(5, 1) = c * s;
  Q(5, 5) = c * c - s * s;
  Q(2, 2) = 1;
  Q(3, 3) = Q(4, 4) = c;
  Q(3, 4) = -s;
  Q(4, 3) = s;
  return Q;
}

// The same for strain with engineering shears.
VoigtMatrix strain_to_wood(double c, double s) {
  VoigtMatrix T = stress_to_wood(c, s);
  T(0, 5) = c * s;
  T(1, 5) = -c * s;
  T(5, 0) = -2 * c * s;
  T(5, 1) = 2 * c * s;
  return T;
}

VoigtMatrix symmetric(const VoigtMatrix& A) {
  return 0.5 * (A + A.transpose());
}

// Without the entries between the stresses of the section (11, 22, 33, 13) and the shears across (23, 12), and between
// these two.
VoigtMatrix without_shears_across(VoigtMatrix A) {
  for (const int shear : {3, 5}) {
    for (int i = 0; i < 6; ++i) {
      if (i != shear) A(i, shear) = A(shear, i) = 0;
    }
  }
  return A;
}

// Name of one of an enum's values: "exact" of {"exact", "uncoupled"}.
template <class Choice, std::size_t N>
Choice choice_from_name(const std::string& what, const std::string& text, const std::array<Choice, N>& choices) {
  std::vector<std::string> names;
  for (const Choice choice : choices) {
    if (text == name(choice)) return choice;
    names.emplace_back(name(choice));
  }
  throw InputError(fmt::format("{} '{}' is not known; allowed: {}", what, text, fmt::join(names, ", ")));
}

}  // namespace

const char* name(Law law) {
  return law == Law::kHill ? "hill" : "crushing";
}
Law law_from_name(const std::string& text) {
  return choice_from_name("law", text, std::array{Law::kHill, Law::kCrushing});
}

const char* name(OffAxis choice) {
  return choice == OffAxis::kExact ? "exact" : "uncoupled";
}
OffAxis off_axis_from_name(const std::string& text) {
  return choice_from_name("offaxis", text, std::array{OffAxis::kExact, OffAxis::kUncoupled});
}

const std::vector<Material>& library() {
  static const std::vector<Material> materials = [] {
    Material poplar;  // Le (2010) Table 3.1
    poplar.name = "poplar";
    Material vtc = poplar;  // Table 3.2: the same wood densified
    vtc.name = "vtc";
    vtc.density_kg_m3 = 910;
    vtc.E_L = 24311;
    vtc.E_R = 2153;
    vtc.E_T = 1005;
    vtc.G_RL = 1616;
    vtc.G_TL = 1486;
    vtc.G_RT = 235;
    vtc.S_RT = 10;
    vtc.crushing.start = 1 - poplar.density_kg_m3 / vtc.density_kg_m3;  // .615
    return std::vector<Material>{poplar, vtc};
  }();
  return materials;
}

void validate(const Material& material) {
  check_signs(material);
  check_positive_definite(material);
  if (material.law == Law::kCrushing) {
    check_crushing(material);
  } else {
    check_hill_constants(material);
    check_hill(material);
  }
}

VoigtMatrix compliance(const Material& m) {
  VoigtMatrix S = VoigtMatrix::Zero();
  S(kL, kL) = 1 / m.E_L;
  S(kR, kR) = 1 / m.E_R;
  S(kT, kT) = 1 / m.E_T;
  S(kR, kL) = S(kL, kR) = -m.nu_RL / m.E_R;
  S(kT, kL) = S(kL, kT) = -m.nu_TL / m.E_T;
  S(kT, kR) = S(kR, kT) = -m.nu_TR / m.E_T;
  S(kTR, kTR) = 1 / m.G_RT;
  S(kLR, kLR) = 1 / m.G_RL;
  S(kLT, kLT) = 1 / m.G_TL;
  return S;
}

VoigtMatrix stiffness(const Material& m) {
  const Eigen::Matrix3d normal = compliance(m).topLeftCorner<3, 3>();
  VoigtMatrix C = VoigtMatrix::Zero();
  C.topLeftCorner<3, 3>() = normal.inverse();
  C(kTR, kTR) = m.G_RT;
  C(kLR, kLR) = m.G_RL;
  C(kLT, kLT) = m.G_TL;
  return symmetric(C);
}

Material softened(Material m, double yield_factor) {
  for (double* stress : {&m.Y_L, &m.Y_R, &m.Y_T, &m.S_RT, &m.S_RL, &m.S_TL, &m.hardening_K}) *stress *= yield_factor;
  auto& k = m.crushing;
  for (double* stress : {&k.Y_L, &k.Y_R, &k.Y_T, &k.S_RT, &k.S_RL, &k.S_TL}) *stress *= yield_factor;
  return m;
}

StrandMaterial in_strand_axes(const Material& material, double angle_deg, OffAxis off_axis) {
  const auto [c, s] = cos_sin(angle_deg);
  const VoigtMatrix T = strain_to_wood(c, s), Q = stress_to_wood(c, s);
  const bool crushes = material.law == Law::kCrushing;
  const VoigtMatrix surface = crushes ? crushing_in_wood_axes(material.crushing) : hill_in_wood_axes(material);
  StrandMaterial out;
  out.density = material.density_kg_m3 * kTonnePerMm3;
  out.stiffness = symmetric(T.transpose() * stiffness(material) * T);
  out.yield_surface = symmetric(Q.transpose() * surface * Q);
  out.Y_R = material.Y_R;
  out.hardening_K = material.hardening_K;
  out.hardening_n = material.hardening_n;
  if (crushes) out.crushing = crushing_hardening(material);
  if (off_axis == OffAxis::kUncoupled && c != 0 && s != 0) {
    // No stress in the shears across: what is left of the compliance and of the surface is the rest of each.
    const VoigtMatrix compliance_here = symmetric(Q.transpose() * compliance(material) * Q);
    out.stiffness = symmetric(without_shears_across(compliance_here).inverse());
    out.yield_surface = without_shears_across(out.yield_surface);
  }
  return out;
}

}  // namespace strandlab::wood
