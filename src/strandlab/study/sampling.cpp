#include "strandlab/study/sampling.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "strandlab/core/random.hpp"

namespace strandlab::study {
namespace {

double rounded(double value, int digits) {
  return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr) + 0.0;  // no -0
}

constexpr double kTouches = 1e-9;  // of a step: what rounding leaves of one that leads to the end

}  // namespace

std::vector<double> stepped(double from, double to, double step) {
  std::vector<double> values;
  const auto last = std::floor((to - from) / step + kTouches);
  for (double i = 0; i <= last; ++i) values.push_back(rounded(from + i * step, 12));
  return values;
}

std::vector<double> spaced(double from, double to, int count) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) values.push_back(rounded(from + (to - from) * i / (count - 1), 12));
  return values;
}

std::vector<std::vector<double>> latin_hypercube(const std::vector<Interval>& intervals, int samples,
                                                 std::uint64_t seed) {
  const auto n = static_cast<std::size_t>(samples);
  std::vector<std::vector<double>> result(n);
  for (std::size_t k = 0; k < intervals.size(); ++k) {
    RandomStream random(seed, k);
    std::vector<std::size_t> strata(n);
    std::iota(strata.begin(), strata.end(), std::size_t{0});
    for (std::size_t i = n; i > 1; --i)  // Fisher and Yates
      std::swap(strata[i - 1], strata[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
    const auto& [from, to] = intervals[k];
    for (std::size_t i = 0; i < n; ++i) {
      const double place = (static_cast<double>(strata[i]) + random.uniform()) / samples;
      result[i].push_back(rounded(from + (to - from) * place, 9));
    }
  }
  return result;
}

}  // namespace strandlab::study
