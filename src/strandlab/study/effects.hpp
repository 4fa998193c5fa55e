// What each factor of a plan does to the moduli.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "strandlab/study/observations.hpp"
#include "strandlab/study/plan.hpp"

namespace strandlab::study {

// Two cells that differ in a contrast of the plan only, one pair for each combination of the other blocks.
struct ContrastedCells {
  std::string name;                 // "press.speed_m_s: 16 - 4"
  std::vector<std::string> values;  // of the varied keys, for people; "16 - 4" where the cells differ
  std::size_t first = 0, second = 0;
};
std::vector<ContrastedCells> contrasted_cells(const Plan& plan);

struct Effect {
  std::string factor;  // the key, or the keys of a [[zip]], joined by " + "
  std::string value, against;
  Finding finding;
};

// Of an axis and a zip: each value against the first, mean over all combinations of the other blocks, paired by
// replicate. One at a time: each value against the base case. Of a Latin hypercube: what the linear regression on its
// keys gives from `from` to `to`; its interval is that of the slope.
std::vector<Effect> main_effects(const Plan& plan, const Observations& observations);

}  // namespace strandlab::study
