#include "strandlab/glue/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace strandlab::glue {
namespace {

struct Measured {
  double compliance_t;  // mm/MPa
  const char* resin;
};

// Le (2010), Table 2.1; strands of hybrid poplar but for those on VTC.
constexpr std::array<Measured, 7> kMeasured{{{.0021, "PF on VTC 25 %"},
                                             {.0105, "PF 25 %"},
                                             {.0118, "PF on VTC 1 %"},
                                             {.0163, "PF 1 %"},
                                             {.037, "PVA 100 %"},
                                             {.065, "PVA 25 %"},
                                             {.146, "PVA 1 %"}}};

}  // namespace

std::string resin_of(double compliance_t_mm_per_MPa) {
  if (compliance_t_mm_per_MPa <= 0) return "perfect bond";
  const auto* const found = std::find_if(kMeasured.begin(), kMeasured.end(), [&](const Measured& m) {
    return std::abs(m.compliance_t - compliance_t_mm_per_MPa) < 1e-9;
  });
  return found == kMeasured.end() ? "" : found->resin;
}

std::string name_of_bond(double compliance_t_mm_per_MPa) {
  const auto resin = resin_of(compliance_t_mm_per_MPa);
  return resin.empty() ? fmt::format("1/D_t {:.4g}", compliance_t_mm_per_MPa) : resin;
}

}  // namespace strandlab::glue
