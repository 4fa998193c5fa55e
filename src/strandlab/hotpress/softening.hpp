// How much softer wood is where it is hot and moist, across the grain.
#pragma once

namespace strandlab::hotpress {

// Anchors: Wood Handbook (FPL-GTR-190) Table 5-15 between 20 and 50 C; beyond 50 C extrapolated down to the floor r,
// for which no measured value was at hand (docs/hotpress.md).
struct Softening {
  double floor = .3;                            // r, what is left far above the softening point
  double kappa_dry = .0105, kappa_wet = .0262;  // 1/K, decay with temperature of dry and of moist wood
  double k_yield = .044, k_stiffness = .031;    // per % of moisture content
};

// Factor of temperature alone, 1 at 20 C:  A = r + (1 - r) exp(-kappa(M) (T - 20)),
// kappa = kappa_dry + (kappa_wet - kappa_dry)/(1 + exp(-(M - .098)/.015)). T in C, M in kg/kg.
double heat_factor(const Softening& s, double T, double M);

// Yield stresses, and elastic moduli, over those at 20 C and 12 %: exp(-k (100 min(M, .25) - 12)) A. They exceed 1
// where the wood is cold and dry.
double yield_factor(const Softening& s, double T, double M);
double stiffness_factor(const Softening& s, double T, double M);

}  // namespace strandlab::hotpress
