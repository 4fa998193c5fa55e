// Results of the benchmark as text.
#pragma once

#include <string>
#include <vector>

#include "strandlab/benchmark/standard.hpp"

namespace strandlab::benchmark {

// For people; speed-ups are those over the first.
std::string text_of(const std::vector<Result>& results);
// A JSON list of objects, one per thread count.
std::string json_of(const std::vector<Result>& results);

}  // namespace strandlab::benchmark
