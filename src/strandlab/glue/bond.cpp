#include "strandlab/glue/bond.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace strandlab::glue {
namespace {

double stiffness_of(double compliance, double penalty) {
  return taken(compliance) > 0 ? std::max(std::min(1 / compliance, penalty), kSoftest) : penalty;
}

void add_remark(const char* symbol, double compliance, std::vector<std::string>& sentences) {
  if (taken(compliance) != compliance) {
    sentences.push_back(fmt::format("The glue compliance 1/{} = {} mm/MPa is negative; it is taken as a perfect bond.",
                                    symbol, compliance));
  } else if (compliance > 0 && 1 / compliance < kSoftest) {
    sentences.push_back(
        fmt::format("The glue stiffness {} = {:.3g} MPa/mm is raised to {} MPa/mm to keep the panel in one piece.",
                    symbol, 1 / compliance, kSoftest));
  }
}

}  // namespace

double taken(double compliance_mm_per_MPa) {
  return std::max(compliance_mm_per_MPa, 0.0);
}

BondStiffness stiffness(const Bond& bond, double penalty) {
  BondStiffness s;
  s.tangential = stiffness_of(bond.compliance_t, penalty);
  s.normal = stiffness_of(bond.compliance_n, penalty);
  s.perfect_t = s.tangential == penalty;
  s.perfect_n = s.normal == penalty;
  return s;
}

Bond unfinished(const Bond& bond, double quality) {
  if (quality >= 1) return bond;
  return {taken(bond.compliance_t) / quality + (1 / quality - 1) * kUnfinished, bond.compliance_n};
}

Bond at_point(const Bond& bond, double quality, double lacking) {
  if (lacking == 0) return unfinished(bond, quality);
  return unfinished({taken(bond.compliance_t) + lacking, bond.compliance_n}, quality);
}

std::vector<std::string> remarks(const Bond& bond) {
  std::vector<std::string> sentences;
  add_remark("D_n", bond.compliance_n, sentences);
  add_remark("D_t", bond.compliance_t, sentences);
  return sentences;
}

}  // namespace strandlab::glue
