#include "strandlab/glue/coverage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "strandlab/core/error.hpp"
#include "strandlab/core/random.hpp"

namespace strandlab::glue {
namespace {

constexpr std::uint64_t kStreams = 1ULL << 40;  // of faces, beyond those of rows and strands of the mat

}  // namespace

void check(const Coverage& coverage) {
  if (!(coverage.mean > 0) || !(coverage.mean <= 1))
    throw InputError(
        fmt::format("resin covers {} of the faces: it must be greater than 0 and at most 1", coverage.mean));
  if (!(coverage.spot_mm >= 0) || !std::isfinite(coverage.spot_mm)) {
    throw InputError(fmt::format("spots of resin of {} mm: their length must be positive, or 0 for the mean everywhere",
                                 coverage.spot_mm));
  }
  const auto& part = coverage.classes;
  const auto& compliance = coverage.compliances;
  const bool increasing = std::adjacent_find(part.begin(), part.end(), std::greater_equal<>()) == part.end();
  const bool falling = std::adjacent_find(compliance.begin(), compliance.end(), std::less<>()) == compliance.end();
  if (part.empty() || part.size() != compliance.size() || !increasing || !falling || !(part.front() > 0) ||
      part.back() != 1 || !(compliance.back() >= 0) ||
      !(compliance.front() < std::numeric_limits<double>::infinity())) {
    throw InputError(fmt::format(
        "classes of coverage [{}] with 1/D_t = [{}]: as many of both are needed, coverages increasing from above 0 to "
        "1, compliances not increasing and not negative",
        fmt::join(part, ", "), fmt::join(compliance, ", ")));
  }
}

double lacking(const Coverage& coverage, double covered) {
  const auto& part = coverage.classes;
  const auto& compliance = coverage.compliances;
  if (covered <= 0) return std::numeric_limits<double>::infinity();
  if (covered <= part.front()) return compliance.front() * part.front() / covered - compliance.back();
  const auto above = std::lower_bound(part.begin(), part.end(), std::min(covered, 1.));
  const auto k = static_cast<std::size_t>(above - part.begin());
  const double share = (std::min(covered, 1.) - part[k - 1]) / (part[k] - part[k - 1]);
  return compliance[k - 1] + share * (compliance[k] - compliance[k - 1]) - compliance.back();
}

Spots::Spots(const Coverage& coverage, double length_mm, std::uint64_t face) {
  if (coverage.mean >= 1) {
    spots_ = {{0, length_mm}};
    return;
  }
  RandomStream random(coverage.seed, kStreams + face);
  const double apart = coverage.spot_mm / -std::log1p(-coverage.mean), half = .5 * coverage.spot_mm;
  double middle = -half;
  while (true) {
    middle -= apart * std::log(random.uniform());
    if (middle >= length_mm + half) return;
    if (!spots_.empty() && middle - half <= spots_.back()[1]) {
      spots_.back()[1] = middle + half;
    } else {
      spots_.push_back({middle - half, middle + half});
    }
  }
}

double Spots::covered(double from_mm, double to_mm) const {
  auto spot = std::partition_point(spots_.begin(), spots_.end(), [&](const auto& s) { return s[1] <= from_mm; });
  double sum = 0;
  for (; spot != spots_.end() && (*spot)[0] < to_mm; ++spot)
    sum += std::min((*spot)[1], to_mm) - std::max((*spot)[0], from_mm);
  return sum / (to_mm - from_mm);
}

}  // namespace strandlab::glue
