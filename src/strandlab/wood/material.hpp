// Wood of a strand: orthotropic elasticity (L, R, T) and a quadratic yield surface with one of two laws of hardening:
// Hill's with a power law (yield without change of volume), or crushing (cells collapse, densification).
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "strandlab/core/types.hpp"
#include "strandlab/wood/hardening.hpp"

namespace strandlab::wood {

enum class Law { kHill, kCrushing };
const char* name(Law law);                   // "hill", "crushing"
Law law_from_name(const std::string& text);  // throws InputError with the allowed names

// Constants of the crushing law, as measured for poplar of 350 kg/m^3:
//   f^2 = (s_L/Y_L)^2 + (s_R/Y_R)^2 + (s_T/Y_T)^2 - 2 c s_R s_T/(Y_R Y_T) + sum (tau_ij/S_ij)^2,  yield at f = H(x),
//   H = 1 + h1 x + h2 (x/(x_L - x))^m,  x_L = 1 - rho0/1500
// with x the collapsed part of the volume. Wood that comes densified has collapsed by `start` already; its uncrushed
// density is rho0 = density (1 - start).
struct Crushing {
  double Y_L = 40, Y_R = 3, Y_T = 3;          // MPa
  double S_RT = 1.5, S_RL = 6, S_TL = 6;      // MPa
  double c = 0.1;                             // -, plastic Poisson ratio: 0 no lateral flow, 1 no change of volume
  double h1 = 0.5, h2 = 0.5, exponent = 1.3;  // -
  double start = 0;                           // -, x as formed
};

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
  Crushing crushing;
  Law law = Law::kHill;  // which of the two holds: a matter of the strand kind, not of the wood
};

// The built-in library: "poplar" (unmodified hybrid poplar) and "vtc" (densified), Le (2010) Tables 3.1 and 3.2.
const std::vector<Material>& library();

// Throws InputError naming the material, the constant and the rule it breaks: non-positive modulus or density,
// compliance not positive definite, and of the law that holds: yield surface not positive semi-definite (Hill:
// |1/Y_R - 1/Y_T| <= 1/Y_L; crushing: |c| <= 1), hardening K < 0 or n < 1, crushing without room below the cell wall.
void validate(const Material& material);

// The material with yield stresses (of both laws) and hardening modulus K times `yield_factor`, as heat and moisture
// leave it: stresses of a given plastic strain are scaled exactly, for K/Y_R and so alpha stay as they are. Elastic
// moduli are kept.
Material softened(Material material, double yield_factor);

// How a row whose grain lies neither along nor across resists in a section (in both, nothing strains across):
//   exact      the section's shears across, 12 and 23, are zero as its strain across is: the full rotated stiffness
//   uncoupled  the row shears freely across, tau_12 = tau_23 = 0: the rotated compliance without its couplings to these
//              shears, an orthotropic strand whose Young's modulus along is that of a bar cut off the grain
// Aligned rows are the same in both. See docs/theory.md.
enum class OffAxis { kExact, kUncoupled };
const char* name(OffAxis choice);                     // "exact", "uncoupled"
OffAxis off_axis_from_name(const std::string& text);  // throws InputError with the allowed names

// A material seen in the axes of a strand whose grain makes `angle_deg` with the strand's long axis (rotation about the
// thickness). This is all that the engine and the virtual tests need to know of the wood.
struct StrandMaterial {
  double density = 0;         // t/mm^3
  VoigtMatrix stiffness;      // MPa, Kirchhoff stress from logarithmic strain, strand axes
  VoigtMatrix yield_surface;  // 1/MPa^2: f^2 = s^T P s for the Cauchy stress s in strand axes (shears count once)
  double Y_R = 0;             // MPa, makes alpha dimensionless: d alpha = d lambda / Y_R
  double hardening_K = 0;     // MPa: yield at f = 1 + (K/Y_R) alpha^n
  double hardening_n = 0;
  CrushingHardening crushing;  // in place of the power law where crushing.limit > 0
  bool crushes() const { return crushing.limit > 0; }
};
StrandMaterial in_strand_axes(const Material& material, double angle_deg, OffAxis off_axis = OffAxis::kExact);

// Compliance (1/MPa) and stiffness (MPa) in wood axes ordered L, T, R (strand axes at angle 0).
VoigtMatrix compliance(const Material& material);
VoigtMatrix stiffness(const Material& material);

}  // namespace strandlab::wood
