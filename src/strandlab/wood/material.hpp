// Wood of a strand: orthotropic elasticity (L, R, T) and a quadratic yield surface that hardens by one of the laws of
// laws/list.hpp.
#pragma once

#include <string>
#include <vector>

#include "strandlab/core/types.hpp"
#include "strandlab/wood/laws/list.hpp"

namespace strandlab::wood {

const char* name(Law law);                   // "hill", "crushing"
std::vector<std::string> law_names();        // of all laws
Law law_from_name(const std::string& text);  // throws InputError with the allowed names

// The elastic constants, and those of each law as its member: hill.Y_R, crushing.c.
// Poisson ratios nu_ij = -eps_j/eps_i under load along i, so nu_ij/E_i = nu_ji/E_j.
struct Material : LawConstants {
  std::string name;
  double density_kg_m3 = 350;
  double E_L = 9936, E_R = 914, E_T = 427;            // MPa
  double G_RL = 745, G_TL = 686, G_RT = 109;          // MPa
  double nu_RL = 0.028, nu_TL = 0.017, nu_TR = 0.33;  // -
  Law law = Law::kHill;  // which of the two holds: a matter of the strand kind, not of the wood
};

// The built-in library: "poplar" (unmodified hybrid poplar) and "vtc" (densified), Le (2010) Tables 3.1 and 3.2.
const std::vector<Material>& library();

// Throws InputError naming the material, the constant and the rule it breaks: non-positive modulus or density,
// compliance not positive definite, and what the law that holds finds in its constants (yield surface not positive
// semi-definite, hardening that falls or starts infinitely steep).
void validate(const Material& material);

// The material with the constants in MPa of every law (yield stresses, Hill's K) times `yield_factor`, as heat and
// moisture leave it: stresses of a given plastic strain are scaled exactly, for K/Y_R and so alpha stay as they are.
// Elastic moduli are kept.
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
  LawHardening hardening;     // of the law that holds; the first law's always, of others nothing
  // The law that holds: the last of the list whose hardening is there.
  Law law() const;
  double start() const;  // history variable of its law as formed
};
StrandMaterial in_strand_axes(const Material& material, double angle_deg, OffAxis off_axis = OffAxis::kExact);

// Compliance (1/MPa) and stiffness (MPa) in wood axes ordered L, T, R (strand axes at angle 0).
VoigtMatrix compliance(const Material& material);
VoigtMatrix stiffness(const Material& material);

}  // namespace strandlab::wood
