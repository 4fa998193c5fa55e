// Glue lines whose compliance was measured, by the resin and the share of the face that it covers.
#pragma once

#include <string>

namespace strandlab::glue {

// "perfect bond" of 1/D_t = 0 and below; "PF 25 %" and the like of the values of Le (2010), Table 2.1, mm/MPa; "" of
// all others.
std::string resin_of(double compliance_t_mm_per_MPa);

// The same, and "1/D_t 0.03" of others.
std::string name_of_bond(double compliance_t_mm_per_MPa);

}  // namespace strandlab::glue
