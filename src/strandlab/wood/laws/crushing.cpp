#include "strandlab/wood/laws/crushing.hpp"

#include <fmt/format.h>

#include <cmath>

#include "strandlab/wood/laws/law.hpp"
#include "strandlab/wood/material.hpp"

namespace strandlab::wood {
namespace {

constexpr double kCellWallDensity = 1500;  // kg/m^3

void check_crushing(const Material& m) {
  const auto& k = m.crushing;
  check_positive(m, {k.Y_L, k.Y_R, k.Y_T, k.S_RT, k.S_RL, k.S_TL}, "crushing_");
  if (!(std::abs(k.c) <= 1)) {
    reject(m,
           fmt::format("yield surface is not positive semi-definite: crushing_c = {} must lie between -1 and 1", k.c));
  }
  check_not_negative(m, "crushing_h1", k.h1);
  check_not_negative(m, "crushing_h2", k.h2);
  check_exponent(m, "crushing_m", k.exponent);
  if (!(k.start >= 0 && k.start < 1))
    reject(m, fmt::format("crushing_start = {} must be from 0 to less than 1", k.start));
  if (!(m.density_kg_m3 < kCellWallDensity)) {
    reject(m, fmt::format("density_kg_m3 = {} leaves nothing to crush: it must be below that of the cell wall, {}",
                          m.density_kg_m3, kCellWallDensity));
  }
}

VoigtMatrix crushing_surface(const Material& m) {
  const auto& k = m.crushing;
  VoigtMatrix P = uncoupled_surface({k.Y_L, k.Y_R, k.Y_T, k.S_RT, k.S_RL, k.S_TL});
  P(kR, kT) = P(kT, kR) = -k.c / (k.Y_R * k.Y_T);
  return P;
}

Declaration<Material> crushing_constant(const std::string& name, const char* unit, const Range& range,
                                        const std::string& help, double Crushing::*member) {
  return within<Material>(
      [](auto& m) -> auto& { return m.crushing; },
      declare("crushing_" + name, unit, range, "kinds with law = \"crushing\": " + help, member));
}

}  // namespace

Crushing::Hardening Crushing::hardening(const Material& material) {
  const auto& k = material.crushing;
  return {1 - material.density_kg_m3 * (1 - k.start) / kCellWallDensity, k.start, k.h1, k.h2, k.exponent};
}

const LawDescription& Crushing::description() {
  using C = Crushing;
  static const LawDescription crushing{
      "crushing",
      {crushing_constant("Y_L_MPa", "MPa", kPositiveOrInfinite, "yield stress along the grain", &C::Y_L),
       crushing_constant("Y_R_MPa", "MPa", kPositiveOrInfinite, "yield stress, radial", &C::Y_R),
       crushing_constant("Y_T_MPa", "MPa", kPositiveOrInfinite, "yield stress, tangential", &C::Y_T),
       crushing_constant("S_RT_MPa", "MPa", kPositiveOrInfinite, "yield stress in rolling shear", &C::S_RT),
       crushing_constant("S_RL_MPa", "MPa", kPositiveOrInfinite, "yield stress in RL shear", &C::S_RL),
       crushing_constant("S_TL_MPa", "MPa", kPositiveOrInfinite, "yield stress in TL shear", &C::S_TL),
       crushing_constant("c", "", {.lo = -1, .hi = 1},
                         "plastic Poisson ratio; 0: no lateral flow, 1: no change of volume", &C::c),
       crushing_constant("h1", "", kNotNegative, "yield at 1 + h1 x + h2 (x/(x_L - x))^m", &C::h1),
       crushing_constant("h2", "", kNotNegative, "see h1; x_L = 1 - density uncrushed/1500", &C::h2),
       crushing_constant("m", "", {.lo = 1}, "see h1", &C::exponent),
       crushing_constant("start", "", {.lo = 0, .hi = 1, .hi_open = true},
                         "collapsed part x of the volume as formed (densified wood)", &C::start)},
      check_crushing,
      crushing_surface,
      [](const Material& m) {
        return std::vector<std::pair<std::string, double>>{{"Y_R_MPa", m.crushing.Y_R}};
      }};
  return crushing;
}

}  // namespace strandlab::wood
