#include "strandlab/wood/laws/law.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/wood/material.hpp"

namespace strandlab::wood {

const LawDescription& description(Law law) {
  return with_law(law, []<class L>() -> const LawDescription& { return L::description(); });
}

const char* name(Law law) {
  return description(law).name;
}

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for_each_law([&]<class L>() { names.emplace_back(L::description().name); });
  return names;
}

Law law_from_name(const std::string& text) {
  const Law* found = nullptr;
  for_each_law([&]<class L>() {
    if (text == L::description().name) found = &kLaw<L>;
  });
  if (found) return *found;
  throw InputError(fmt::format("law '{}' is not known; allowed: {}", text, fmt::join(law_names(), ", ")));
}

VoigtMatrix uncoupled_surface(const YieldStresses& y) {
  const auto inverse_square = [](double stress) { return 1 / (stress * stress); };
  VoigtMatrix P = VoigtMatrix::Zero();
  P(kL, kL) = inverse_square(y.Y_L);
  P(kR, kR) = inverse_square(y.Y_R);
  P(kT, kT) = inverse_square(y.Y_T);
  P(kTR, kTR) = inverse_square(y.S_RT);
  P(kLR, kLR) = inverse_square(y.S_RL);
  P(kLT, kLT) = inverse_square(y.S_TL);
  return P;
}

void reject(const Material& material, const std::string& what) {
  throw InputError(fmt::format("material \"{}\": {}", material.name, what));
}

void check_positive(const Material& material, const YieldStresses& y, const std::string& prefix) {
  const std::array<std::pair<const char*, double>, 6> yields{
      {{"Y_L", y.Y_L}, {"Y_R", y.Y_R}, {"Y_T", y.Y_T}, {"S_RT", y.S_RT}, {"S_RL", y.S_RL}, {"S_TL", y.S_TL}}};
  for (const auto& [name, value] : yields) {
    if (!(value > 0)) {
      reject(material, fmt::format("{}{} = {} must be positive (or infinite: never yields)", prefix, name, value));
    }
  }
}

void check_not_negative(const Material& material, const char* constant, double value) {
  if (value >= 0 && std::isfinite(value)) return;
  reject(material, fmt::format("{} = {} must be zero or a positive finite number", constant, value));
}

void check_exponent(const Material& material, const char* constant, double value) {
  if (value >= 1 && std::isfinite(value)) return;
  reject(material, fmt::format("{} = {} must be a finite number of at least 1 (below, hardening starts infinitely "
                               "steep)",
                               constant, value));
}

}  // namespace strandlab::wood
