// Wood of a strand: orthotropic elasticity (L, R, T), Hill yield surface and power-law hardening.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "strandlab/core/types.hpp"

namespace strandlab::wood {

// Poisson ratios nu_ij = -eps_j/eps_i under load along i, so nu_ij/E_i = nu_ji/E_j.
struct Material {
  std::string name;
  double density_kg_m3 = 350;
  double E_L = 9936, E_R = 914, E_T = 427;                // MPa
  double G_RL = 745, G_TL = 686, G_RT = 109;              // MPa
  double nu_RL = 0.028, nu_TL = 0.017, nu_TR = 0.33;      // -
  double Y_L = std::numeric_limits<double>::infinity();   // MPa, yield stress along the grain
  double Y_R = 5, Y_T = 5;                                // MPa
  double S_RT = 2.5;                                      // MPa, yield stress in shear
  double S_RL = std::numeric_limits<double>::infinity();  // MPa
  double S_TL = std::numeric_limits<double>::infinity();  // MPa
  double hardening_K = 120;                               // MPa
  double hardening_n = 4;                                 // -
};

// The built-in library: "poplar" (unmodified hybrid poplar) and "vtc" (densified), Le (2010) Tables 3.1 and 3.2.
const std::vector<Material>& library();

// Throws InputError naming the material, the constant and the rule it breaks: non-positive modulus or density,
// compliance not positive definite, yield surface not positive semi-definite (|1/Y_R - 1/Y_T| <= 1/Y_L), hardening K <
// 0 or n < 1.
void validate(const Material& material);

// The material with yield stresses and hardening modulus K times `yield_factor`, as heat and moisture leave it:
// stresses of a given plastic strain are scaled exactly, for K/Y_R and so alpha stay as they are. Elastic moduli are
// kept.
Material softened(Material material, double yield_factor);

// A material seen in the axes of a strand whose grain makes `angle_deg` with the strand's long axis (rotation about the
// thickness). This is all that the engine and the virtual tests need to know of the wood.
struct StrandMaterial {
  double density = 0;      // t/mm^3
  VoigtMatrix stiffness;   // MPa, Kirchhoff stress from logarithmic strain, strand axes
  VoigtMatrix hill;        // 1/MPa^2: f^2 = s^T hill s for the Cauchy stress s in strand axes (shears count once)
  double Y_R = 0;          // MPa, makes alpha dimensionless: d alpha = d lambda / Y_R
  double hardening_K = 0;  // MPa: yield at f = 1 + (K/Y_R) alpha^n
  double hardening_n = 0;
};
StrandMaterial in_strand_axes(const Material& material, double angle_deg);

// Compliance (1/MPa) and stiffness (MPa) in wood axes ordered L, T, R (strand axes at angle 0).
VoigtMatrix compliance(const Material& material);
VoigtMatrix stiffness(const Material& material);

}  // namespace strandlab::wood
