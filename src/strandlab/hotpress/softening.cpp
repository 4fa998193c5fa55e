#include "strandlab/hotpress/softening.hpp"

#include <algorithm>
#include <cmath>

namespace strandlab::hotpress {
namespace {

double moisture_factor(double k, double M) {
  return std::exp(-k * (100 * std::min(M, .25) - 12));
}

}  // namespace

double heat_factor(const Softening& s, double T, double M) {
  const double kappa = s.kappa_dry + (s.kappa_wet - s.kappa_dry) / (1 + std::exp(-(M - .098) / .015));
  return s.floor + (1 - s.floor) * std::exp(-kappa * (T - 20));
}

double yield_factor(const Softening& s, double T, double M) {
  return moisture_factor(s.k_yield, M) * heat_factor(s, T, M);
}

double stiffness_factor(const Softening& s, double T, double M) {
  return moisture_factor(s.k_stiffness, M) * heat_factor(s, T, M);
}

}  // namespace strandlab::hotpress
