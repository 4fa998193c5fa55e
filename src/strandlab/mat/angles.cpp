#include "strandlab/mat/angles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/elementary.hpp"
#include "strandlab/core/error.hpp"

namespace strandlab::mat {
namespace {

constexpr double kAnglesPerDegree = 1e3;  // angles are whole multiples of its inverse
constexpr std::size_t kCells = 3600;      // of the distribution function: within one, the density is taken as constant

}  // namespace

void check(const AngleDistribution& angles, const std::string& where) {
  if (!std::isfinite(angles.mean_deg))
    throw InputError(fmt::format("{}: angle = {} degrees must be a finite number", where, angles.mean_deg));
  const auto within = [&](const char* name, double value, double most, const char* remark) {
    if (value >= 0 && value <= most) return;
    throw InputError(fmt::format("{}: {} = {} must be between 0 and {}{}", where, name, value, most, remark));
  };
  within("angle spread", angles.spread_deg, 90, " degrees (any angle)");
  within("standard deviation of the angle", angles.sd_deg, 90, " degrees");
  within("kappa of the angle", angles.kappa, kMostConcentrated, "");
  if ((angles.spread_deg > 0) + (angles.sd_deg > 0) + (angles.kappa > 0) > 1) {
    throw InputError(fmt::format(
        "{}: angle spread = {}, standard deviation = {} and kappa = {}: strands have one distribution of angles", where,
        angles.spread_deg, angles.sd_deg, angles.kappa));
  }
}

AngleSampler::AngleSampler(const AngleDistribution& angles) : angles_(angles) {
  if (!(angles.kappa > 0)) return;
  const auto density = [&](double deviation) {
    return portable_exp(angles.kappa * (cos_sin_degrees(2 * deviation).cos - 1));
  };
  constexpr double kCell = 180.0 / kCells;
  share_.push_back(0);
  for (std::size_t i = 0; i < kCells; ++i)
    share_.push_back(share_.back() + density(kCell * (static_cast<double>(i) + 0.5) - 90));
  for (double& share : share_) share /= share_.back();
}

double AngleSampler::draw(RandomStream& random) const {
  const double angle = angles_.mean_deg + deviation(random);
  return static_cast<double>(std::llround(angle * kAnglesPerDegree)) / kAnglesPerDegree;
}

double AngleSampler::deviation(RandomStream& random) const {
  if (angles_.sd_deg > 0) return std::remainder(angles_.sd_deg * random.normal(), 180.0);
  const double u = random.uniform();
  return angles_.kappa > 0 ? von_mises(u) : angles_.spread_deg * (2 * u - 1);
}

double AngleSampler::von_mises(double u) const {
  const auto above = static_cast<std::size_t>(std::upper_bound(share_.begin(), share_.end() - 1, u) - share_.begin());
  const double inside = (u - share_[above - 1]) / (share_[above] - share_[above - 1]);
  return 180.0 / kCells * (static_cast<double>(above - 1) + inside) - 90;
}

}  // namespace strandlab::mat
