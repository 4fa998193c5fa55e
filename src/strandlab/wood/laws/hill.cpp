#include "strandlab/wood/laws/hill.hpp"

#include <fmt/format.h>

#include <cmath>

#include "strandlab/wood/laws/law.hpp"
#include "strandlab/wood/material.hpp"

namespace strandlab::wood {
namespace {

// Hill's form does not see pressure, so it is positive semi-definite when 1/Y_L, 1/Y_R, 1/Y_T can be the sides of a
// triangle.
void check_triangle(const Material& m) {
  const auto& k = m.hill;
  const double l = 1 / k.Y_L, r = 1 / k.Y_R, t = 1 / k.Y_T;
  const double round_off = 1e-12 * (r + t);
  if (std::abs(r - t) > l + round_off) {
    reject(m, fmt::format("yield surface is not positive semi-definite: Y_R = {}, Y_T = {}, Y_L = {} break the rule "
                          "|1/Y_R - 1/Y_T| <= 1/Y_L (with Y_L infinite, Y_R must equal Y_T)",
                          k.Y_R, k.Y_T, k.Y_L));
  }
  if (l > r + t + round_off) {
    reject(m, fmt::format("yield surface is not positive semi-definite: Y_L = {} breaks the rule "
                          "1/Y_L <= 1/Y_R + 1/Y_T with Y_R = {}, Y_T = {}",
                          k.Y_L, k.Y_R, k.Y_T));
  }
}

void check_hill(const Material& m) {
  const auto& k = m.hill;
  check_positive(m, {k.Y_L, k.Y_R, k.Y_T, k.S_RT, k.S_RL, k.S_TL}, "");
  if (!std::isfinite(k.Y_R)) reject(m, "Y_R must be finite: it is the scale of the hardening law 1 + (K/Y_R) alpha^n");
  check_not_negative(m, "hardening_K", k.K);
  check_exponent(m, "hardening_n", k.n);
  check_triangle(m);
}

double inverse_square(double y) {
  return 1 / (y * y);
}

// Hill (1950), with F, G, H from the three yield stresses.
VoigtMatrix hill_surface(const Material& m) {
  const auto& k = m.hill;
  const double l = inverse_square(k.Y_L), r = inverse_square(k.Y_R), t = inverse_square(k.Y_T);
  VoigtMatrix P = uncoupled_surface({k.Y_L, k.Y_R, k.Y_T, k.S_RT, k.S_RL, k.S_TL});
  P(kR, kT) = P(kT, kR) = -0.5 * (r + t - l);
  P(kL, kT) = P(kT, kL) = -0.5 * (l + t - r);
  P(kL, kR) = P(kR, kL) = -0.5 * (l + r - t);
  return P;
}

Declaration<Material> hill_constant(const char* name, const char* unit, const Range& range, const char* help,
                                    double Hill::*member) {
  return within<Material>(
      [](auto& m) -> auto& { return m.hill; }, declare(name, unit, range, help, member));
}

}  // namespace

Hill::Hardening Hill::hardening(const Material& material) {
  return {material.hill.Y_R, material.hill.K, material.hill.n};
}

const LawDescription& Hill::description() {
  static const LawDescription hill{
      "hill",
      {hill_constant("Y_L_MPa", "MPa", kPositiveOrInfinite, "yield stress along the grain", &Hill::Y_L),
       hill_constant("Y_R_MPa", "MPa", kPositive, "yield stress, radial", &Hill::Y_R),
       hill_constant("Y_T_MPa", "MPa", kPositive, "yield stress, tangential", &Hill::Y_T),
       hill_constant("S_RT_MPa", "MPa", kPositiveOrInfinite, "yield stress in rolling shear", &Hill::S_RT),
       hill_constant("S_RL_MPa", "MPa", kPositiveOrInfinite, "yield stress in RL shear", &Hill::S_RL),
       hill_constant("S_TL_MPa", "MPa", kPositiveOrInfinite, "yield stress in TL shear", &Hill::S_TL),
       hill_constant("hardening_K_MPa", "MPa", kNotNegative, "hardening: yield at 1 + (K/Y_R) alpha^n", &Hill::K),
       hill_constant("hardening_n", "", {.lo = 1}, "exponent of the hardening", &Hill::n)},
      check_hill,
      hill_surface,
      [](const Material& m) {
        return std::vector<std::pair<std::string, double>>{{"Y_R_MPa", m.hill.Y_R}, {"hardening_K_MPa", m.hill.K}};
      }};
  return hill;
}

}  // namespace strandlab::wood
