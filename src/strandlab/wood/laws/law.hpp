// What rooms outside know of a law of yielding, whichever it is.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "strandlab/core/declaration.hpp"
#include "strandlab/core/types.hpp"
#include "strandlab/wood/laws/list.hpp"

namespace strandlab::wood {

struct Material;

struct LawDescription {
  const char* name;  // in cases: "hill"
  // Its constants as keys of [materials.NAME], in that order. Those in MPa are stresses: heat and moisture soften them
  // alike (softened()).
  std::vector<Declaration<Material>> constants;
  // Throws InputError naming the material, the constant and the rule it breaks.
  void (*check)(const Material&);
  // f^2 = s^T P s for the Cauchy stress s, 1/MPa^2, in wood axes (below).
  VoigtMatrix (*yield_surface)(const Material&);
  // The numbers that say in a line how it yields, for people: name with unit, value.
  std::vector<std::pair<std::string, double>> (*in_short)(const Material&);
};

const LawDescription& description(Law law);

// ---- For the laws' own files ----------------------------------------------------------------------------------------

// Places of the wood axes and of the shears in the Voigt order of a strand at angle 0.
inline constexpr int kL = 0, kT = 1, kR = 2, kTR = 3, kLR = 4, kLT = 5;

// The part of a quadratic yield surface that couples no two stresses: 1/Y^2 of each; an infinite one leaves a zero.
struct YieldStresses {
  double Y_L, Y_R, Y_T, S_RT, S_RL, S_TL;  // MPa
};
VoigtMatrix uncoupled_surface(const YieldStresses& yields);

[[noreturn]] void reject(const Material& material, const std::string& what);
// Refuses yield stresses that are not positive. Their names in the message begin with `prefix`.
void check_positive(const Material& material, const YieldStresses& yields, const std::string& prefix);
// Refuses a number that is negative or not finite.
void check_not_negative(const Material& material, const char* constant, double value);
// Refuses an exponent of hardening below 1.
void check_exponent(const Material& material, const char* constant, double value);

}  // namespace strandlab::wood
