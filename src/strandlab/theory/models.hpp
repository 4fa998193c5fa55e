// Closed-form estimates of panel density and moduli, and of strands whose grain lies off the section. Le (2010),
// chapters 3 to 6, with its misprints corrected; see docs/theory.md.
#pragma once

#include <string>
#include <vector>

#include "strandlab/mat/form.hpp"
#include "strandlab/wood/material.hpp"

namespace strandlab::theory {

// How a strand whose grain is neither along nor across the section resists: as a bar cut off the grain, which strains
// and shears freely across (uncoupled), or held in plane strain as in the simulations (exact).
using wood::OffAxis;

// A strand that is known, of a given mat.
struct Piece {
  wood::Material material;
  double angle_deg = 0;
  double length_mm = 0;  // its share of the row's wood counts
};

// One row of strands.
struct Row {
  wood::Material material;
  double angle_deg = 0;              // grain against the section: 0 surface, 90 core
  mat::StrandStatistics statistics;  // mm along the section; length 0 and gap 0: one strand fills the row
  double thickness_mm = 0.8;
  double angle_spread_deg = 0, angle_sd_deg = 0;  // of its strands' angles, mat::AngleDistribution
  std::vector<Piece> pieces = {};                 // where they are known: in place of one material and angle for all
};

// Mean <L>/(<L> + <G>), the part of a row that is wood; 1 for a full row.
double solid_fraction(const mat::StrandStatistics& statistics);
// Grain within 45 degrees of the section, of every strand or, where angles are normal, to one standard deviation: these
// rows carry the load, the others are core.
bool runs_along(const Row& row);

// --- a strand ---
// Modulus of a bar cut at an angle to the grain, MPa: 1/E = c^4/E_L + (1/G_TL - 2 nu_LT/E_L) s^2 c^2 + s^4/E_T.
// Jones, Mechanics of Composite Materials (1999), section 2.6; Le (2010), appendix 3.3.
double off_axis_modulus_MPa(const wood::Material& material, double angle_deg);
// Modulus along a plane-strain section through a strand at an angle, free through the thickness, MPa:
// C11 - C13^2/C33 of the stiffness in strand axes.
double plane_strain_modulus_MPa(const wood::Material& material, double angle_deg);
// Means over angles uniform in +-90 degrees, MPa.
double off_axis_average_MPa(const wood::Material& material);
double plane_strain_average_MPa(const wood::Material& material);
// Laminate with plies in all directions alike, plane stress, MPa: (U1^2 - U4^2)/U1 with the lamina invariants U1, U4.
// Jones, Mechanics of Composite Materials (1999), section 4.4.
double quasi_isotropic_modulus_MPa(const wood::Material& material);
// Modulus of a row's solid wood along the section, MPa: the mean over its strands or their angles.
double strand_modulus_MPa(const Row& row, OffAxis off_axis);

// --- a panel at compaction C, MPa ---
// Homogenised rule of mixtures: mean over rows, by thickness, of modulus times solid fraction, over 1 - C. Le (2010)
// Eq. 3.8, 3.9.
double tension_modulus_MPa(const std::vector<Row>& rows, double compaction, OffAxis off_axis = OffAxis::kUncoupled);
// Laminated beam: sum of E_i I_i of the rows over I, over 1 - C. With two outer rows and an even core Le (2010),
// Eq. 4.6 to 4.8.
double bending_modulus_MPa(const std::vector<Row>& rows, double compaction, OffAxis off_axis = OffAxis::kUncoupled);
// The same from row moduli that already contain their gaps; rows are equally thick where no thicknesses are given.
double tension_of_moduli_MPa(const std::vector<double>& row_moduli, double compaction,
                             const std::vector<double>& thicknesses_mm = {});
double bending_of_moduli_MPa(const std::vector<double>& row_moduli, double compaction,
                             const std::vector<double>& thicknesses_mm = {});
// Rule of mixtures with a core (every row that does not run along) of strands at random angles, whose solid modulus is
// `core_modulus`.
double random_core_modulus_MPa(const std::vector<Row>& rows, double core_modulus, double compaction,
                               OffAxis off_axis = OffAxis::kUncoupled);

// Strands of length l and modulus E_w in a matrix (what fills the gaps between them), with glue lines of compliance
// 1/D_t: E_x = (1 - tanh(gamma)/gamma) E_w V_w + E_m V_m, gamma^2 = (1/(E_m V_m) + 1/(E_w V_w)) / (V_w/(3 G_w) + V_m/(3
// G_m) + 1/(t D_t)) (l/(2t))^2. Le (2010) Eq. 5.1 to 5.5.
struct ShearLag {
  double E_w_MPa = 9936, G_w_MPa = 745, V_w = 1;  // wood
  double E_m_MPa = 1500, G_m_MPa = 500;           // matrix; V_m = 1 - V_w
  double length_mm = 150, spacing_mm = 0.8;       // of strands: along, and t between their mid planes
};
// Stress-transfer efficiency 1 - tanh(gamma)/gamma of the strands; 1 without matrix (a row without gaps),
// 0 without strands.
double strand_efficiency(const ShearLag& strands, double compliance_t_mm_per_MPa);
double shear_lag_modulus_MPa(const ShearLag& strands, double compliance_t_mm_per_MPa);

// What fills the gaps in the shear-lag model. Le (2010), Fig. 5.8.
struct Matrix {
  double modulus_MPa = 1500, shear_MPa = 500;
};
// Rule of mixtures with shear-lag moduli in the rows that run along, t = the row's thickness before pressing. Le
// Eq. 5.6.
double shear_lag_panel_MPa(const std::vector<Row>& rows, const Matrix& matrix, double compliance_t_mm_per_MPa,
                           double compaction, OffAxis off_axis = OffAxis::kUncoupled);

// --- density ---
// Mean density, kg/m^3: mean over rows, by thickness, of density times solid fraction, over 1 - C. Le (2010), Eq. 6.1
// and what follows it.
double density_kg_m3(const std::vector<Row>& rows, double compaction);
// Modulus (MPa) of a panel of given density: tension modulus over density is the same at every compaction. Le Eq. 6.4.
double modulus_at_density_MPa(const std::vector<Row>& rows, double density_kg_m3,
                              OffAxis off_axis = OffAxis::kUncoupled);

}  // namespace strandlab::theory
