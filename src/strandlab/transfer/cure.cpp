#include "strandlab/transfer/cure.hpp"

#include <algorithm>
#include <cmath>

#include "strandlab/transfer/properties.hpp"

namespace strandlab::transfer {

const std::vector<Resin>& resins() {
  static const std::vector<Resin> list{{"pf", 85e3, 7.8e9, 1, .5}, {"pmdi", 65e3, 5.5e7, 1, .5}};
  return list;
}

double cure_rate(const Resin& resin, double T) {
  return resin.rate_1_s * std::exp(-resin.activation_J_mol / (kGasConstant * (T + kZeroCelsius)));
}

// n = 1: 1 - alpha falls by exp(-k t); else (1 - alpha)^(1 - n) grows by (n - 1) k t, which for n < 1 ends at full
// cure.
double cured(const Resin& resin, double alpha, double T, double seconds) {
  const double left = 1 - alpha, kt = cure_rate(resin, T) * seconds, n = resin.order;
  if (left <= 0) return 1;
  if (std::abs(n - 1) < 1e-9) return alpha - left * std::expm1(-kt);
  const double power = std::pow(left, 1 - n) + (n - 1) * kt;
  return power <= 0 ? 1 : 1 - std::pow(power, -1 / (n - 1));
}

double bond_strength(const Resin& resin, double alpha) {
  return std::max(0., (alpha - resin.gel) / (1 - resin.gel));
}

}  // namespace strandlab::transfer
