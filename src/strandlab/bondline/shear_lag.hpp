// Double-lap-shear specimen with imperfect glue lines: shear-lag stiffness, and the tangential glue compliance 1/D_t
// that a measured stiffness stands for.
#pragma once

#include <optional>
#include <string>

namespace strandlab::bondline {

inline constexpr double kNormal975 = 1.959963984540054;  // two-sided 95 % point of the normal distribution

// Which closed form of the compliance ratio C/C_inf is used.
enum class Formula {
  kCoth,    // shear-lag solution in tanh and coth (default)
  kLe2010,  // Le (2010), Eq. 2.2 as printed, with its missing factor l restored; 1/D_t comes out about 1 % larger
};
const char* name(Formula formula);                   // "coth", "le2010"
Formula formula_from_name(const std::string& name);  // throws InputError with the allowed names

// Specimen: two outer strands (1) lap a centre strand (2) from both sides over the length l; free tabs L1 (outer
// strands) and L2 (centre strand) lie within the gauge length. Le (2010), Fig. 2.2.
struct Geometry {
  double E1_MPa = 9936, E2_MPa = 9936;   // along the strands
  std::optional<double> G1_MPa, G2_MPa;  // through-thickness shear modulus; not given: E/15
  double t1_mm = 0.69, t2_mm = 0.69;     // strand thickness
  double W_mm = 6;                       // width
  double l_mm = 25;                      // overlap
  double L1_mm = 0, L2_mm = 0;           // tabs
  double shear1_MPa() const { return G1_MPa.value_or(E1_MPa / 15); }
  double shear2_MPa() const { return G2_MPa.value_or(E2_MPa / 15); }
};

// Says what is wrong with a geometry ("t1_mm = -0.69 must be positive"), empty when nothing is.
std::string fault(const Geometry& specimen);

// Compliance of the glued length relative to three strands that stretch as one, for a glue compliance 1/D_t in mm/MPa.
// Needs compliance > lower_bound(). Nairn (2007), Le (2010) Eq. 2.2.
double compliance_ratio(const Geometry& specimen, double compliance_t_mm_per_MPa, Formula formula = Formula::kCoth);

// Stiffness load/displacement over the gauge length, N/mm.
double stiffness_N_per_mm(const Geometry& specimen, double compliance_t_mm_per_MPa, Formula formula = Formula::kCoth);

// Stiffness that no glue line can reach: C/C_inf = 1. N/mm.
double rigid_limit_N_per_mm(const Geometry& specimen);

// Every 1/D_t is larger than this (negative) value, -(t1/(3 G1) + t2/(6 G2)): an interphase can take away no more than
// the shear compliance of the strands themselves. mm/MPa.
double lower_bound_mm_per_MPa(const Geometry& specimen);

// d ln k / d ln(1/D_t), the relative change of stiffness per relative change of glue compliance; 0 at 1/D_t = 0.
double sensitivity(const Geometry& specimen, double compliance_t_mm_per_MPa, Formula formula = Formula::kCoth);

// 1/D_t of a measured stiffness, mm/MPa, or the reason why there is none.
struct GlueCompliance {
  std::optional<double> value_mm_per_MPa;
  std::string reason;  // plain sentence, empty when there is a value
};
GlueCompliance glue_compliance(const Geometry& specimen, double stiffness_N_per_mm, Formula formula = Formula::kCoth);

// Standard uncertainties of one measurement.
struct Uncertainty {
  double k_relative = 0.01;
  double E_relative = 0.01;
  double t_relative = 0.01;
  double l_mm = 0.25;
};

// What the uncertainties of k, E1, E2, t1, t2 and l (independent; G follows E where it is E/15) make of 1/D_t.
struct Propagated {
  double k_equivalent = 0;         // relative error of k alone that would do the same
  double standard_mm_per_MPa = 0;  // to first order
  double low_mm_per_MPa = 0;       // 95 % interval: the curve k(1/D_t) read at k exp(+-1.96 k_equivalent), because it
  double high_mm_per_MPa = 0;      // bends within the error band; where k would be too stiff, low is the lower bound
};
Propagated propagate(const Geometry& specimen, double compliance_t_mm_per_MPa, const Uncertainty& uncertainty,
                     Formula formula = Formula::kCoth);

// Overlap length that measures a glue compliance best.
struct Design {
  double overlap_mm = 0;                   // smallest uncertainty of 1/D_t
  double relative_uncertainty = 0;         // standard uncertainty of 1/D_t there, over 1/D_t
  double shortest_mm = 0, longest_mm = 0;  // overlaps that are at most 10 % worse
  double sensitivity = 0;                  // d ln k / d ln(1/D_t) there
  double stiffness_N_per_mm = 0;
};
// Searches overlaps between the limits (mm). Throws InputError unless 0 < shortest < longest and 1/D_t > 0.
Design best_overlap(const Geometry& specimen, double compliance_t_mm_per_MPa, const Uncertainty& uncertainty,
                    double shortest_mm, double longest_mm, Formula formula = Formula::kCoth);

}  // namespace strandlab::bondline
