// The bond of a glue line: how far its two faces move against each other under stress.
#pragma once

#include <string>
#include <vector>

namespace strandlab::glue {

// Compliances, mm/MPa: [u_t] = tau/D_t along the line, [u_n] = sigma/D_n across it; measured ones in Le (2010), Table
// 2.1. 0 is a perfect bond, whose faces do not move against each other. A negative one, as tests of an interphase
// stiffer than wood give it, is taken as perfect.
struct Bond {
  double compliance_t = 0;  // 1/D_t
  double compliance_n = 0;  // 1/D_n
};

// The compliance that a bond has where this one is given: itself, or 0 where it is negative.
double taken(double compliance_mm_per_MPa);

// Softest glue line, MPa/mm: below it strands slide freely and there is no panel to solve for. Judgement: 7000 times
// softer than the softest bond of that table, .146 mm/MPa.
inline constexpr double kSoftest = 1e-3;

// A bond as springs, per area.
struct BondStiffness {
  double tangential = 0, normal = 0;          // MPa/mm
  bool perfect_t = false, perfect_n = false;  // then the stiffness is that of a penalty
};

// No softer than kSoftest. `penalty` (MPa/mm) is the stiffness that stands for a perfect bond, and for one as stiff.
BondStiffness stiffness(const Bond& bond, double penalty);

// Of a bond without strength there is no glue line at all: quality below this.
inline constexpr double kLeastQuality = .05;
// 1/D_t of a bond of little resin (PF on a quarter of the face, Le 2010, Table 2.1), mm/MPa: what an unfinished bond
// adds.
inline constexpr double kUnfinished = .0105;

// A bond that is unfinished, of quality Q in kLeastQuality..1: (1/D_t)/Q + (1/Q - 1) kUnfinished, so that a perfect
// bond is perfect only where it is finished; across the line it stays as it is. Judgement.
Bond unfinished(const Bond& bond, double quality);

// The bond of a glue point: of this quality, and with `lacking` (mm/MPa) more 1/D_t where resin does not cover all
// (coverage.hpp).
Bond at_point(const Bond& bond, double quality, double lacking);

// What is not taken as it is given (a negative compliance, one beyond the softest), as sentences.
std::vector<std::string> remarks(const Bond& bond);

}  // namespace strandlab::glue
