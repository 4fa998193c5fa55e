#include "strandlab/wood/material.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "strandlab/core/error.hpp"
#include "strandlab/wood/laws/law.hpp"

namespace strandlab::wood {
namespace {

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

}  // namespace

const char* name(OffAxis choice) {
  return choice == OffAxis::kExact ? "exact" : "uncoupled";
}
OffAxis off_axis_from_name(const std::string& text) {
  for (const OffAxis choice : {OffAxis::kExact, OffAxis::kUncoupled}) {
    if (text == name(choice)) return choice;
  }
  throw InputError(fmt::format("offaxis '{}' is not known; allowed: {}, {}", text, name(OffAxis::kExact),
                               name(OffAxis::kUncoupled)));
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
    vtc.hill.S_RT = 10;
    vtc.crushing.start = 1 - poplar.density_kg_m3 / vtc.density_kg_m3;  // .615
    return std::vector<Material>{poplar, vtc};
  }();
  return materials;
}

void validate(const Material& material) {
  check_signs(material);
  check_positive_definite(material);
  description(material.law).check(material);
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
  for_each_law([&]<class L>() {
    for (const auto& constant : L::description().constants) {
      if (constant.unit == "MPa") constant.set(m, std::get<double>(constant.get(m)) * yield_factor);
    }
  });
  return m;
}

Law StrandMaterial::law() const {
  Law last{};
  for_each_law([&]<class L>() {
    if (part_of<L>(hardening).holds()) last = kLaw<L>;
  });
  return last;
}

double StrandMaterial::start() const {
  return with_law(law(), [&]<class L>() { return part_of<L>(hardening).start(); });
}

StrandMaterial in_strand_axes(const Material& material, double angle_deg, OffAxis off_axis) {
  const auto [c, s] = cos_sin(angle_deg);
  const VoigtMatrix T = strain_to_wood(c, s), Q = stress_to_wood(c, s);
  const VoigtMatrix surface = description(material.law).yield_surface(material);
  StrandMaterial out;
  out.density = material.density_kg_m3 * kTonnePerMm3;
  out.stiffness = symmetric(T.transpose() * stiffness(material) * T);
  out.yield_surface = symmetric(Q.transpose() * surface * Q);
  for_each_law([&]<class L>() {
    if (kLaw<L> == Law{} || kLaw<L> == material.law) part_of<L>(out.hardening) = L::hardening(material);
  });
  if (off_axis == OffAxis::kUncoupled && c != 0 && s != 0) {
    // No stress in the shears across: what is left of the compliance and of the surface is the rest of each.
    const VoigtMatrix compliance_here = symmetric(Q.transpose() * compliance(material) * Q);
    out.stiffness = symmetric(without_shears_across(compliance_here).inverse());
    out.yield_surface = without_shears_across(out.yield_surface);
  }
  return out;
}

}  // namespace strandlab::wood
