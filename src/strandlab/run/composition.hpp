// What a mat is made of, in words and for run.json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "strandlab/panel/panel.hpp"

namespace strandlab::run {

// Weight of panel area, and the percentages of it by strand kind and by material.
std::vector<std::string> composition(const Weight& weight);
// kg_per_m2, weight_fraction_by_kind, weight_fraction_by_material.
nlohmann::json to_json(const Weight& weight);

}  // namespace strandlab::run
