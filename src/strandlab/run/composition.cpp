#include "strandlab/run/composition.hpp"

#include <fmt/format.h>

namespace strandlab::run {
namespace {

std::string percentages(const std::vector<WeightShare>& shares) {
  std::string text;
  for (const auto& share : shares)
    text += fmt::format("{}{} {:.1f} %", text.empty() ? "" : ", ", share.name, 100 * share.fraction);
  return text;
}

}  // namespace

std::vector<std::string> composition(const Weight& weight) {
  return {fmt::format("weight: {:.4g} kg/m2; by kind: {}; by material: {}", weight.kg_per_m2,
                      percentages(weight.by_kind), percentages(weight.by_material))};
}

}  // namespace strandlab::run
