#include "strandlab/mat/cut.hpp"

#include <algorithm>
#include <cmath>

#include "strandlab/core/elementary.hpp"

namespace strandlab::mat {
namespace {

// A rectangle across which a line is moved: the cut grows over `ramp`, stays at `longest` and falls as it grew.
struct Trapezoid {
  double extent = 0;  // of the rectangle across the line
  double ramp = 0, longest = 0;

  Trapezoid(double length, double width, double angle_deg) {
    const auto turn = cos_sin_degrees(angle_deg);
    const double cos = std::abs(turn.cos), sin = std::abs(turn.sin);
    const double from_length = length * sin, from_width = width * cos;
    extent = from_length + from_width;
    ramp = std::min(from_length, from_width);
    longest = from_length > from_width ? width / sin : length / cos;
  }
  double cut(double place) const {  // 0..extent
    const double from_end = std::min(place, extent - place);
    return from_end < ramp ? longest * from_end / ramp : longest;
  }
  double integral_of_square() const { return longest * longest * (extent - 2 * ramp + 2 * ramp / 3); }
};

bool single_angle(const AngleDistribution& a) {
  return a.spread_deg == 0 && a.sd_deg == 0;
}
bool all_along(const AngleDistribution& a) {
  return single_angle(a) && std::remainder(a.mean_deg, 180.0) == 0;
}
bool all_across(const AngleDistribution& a) {
  return single_angle(a) && std::abs(std::remainder(a.mean_deg, 180.0)) == 90;
}

// Means over the angles, by the midpoint rule.
template <class Visit>
void over_angles(const AngleDistribution& a, const Visit& visit) {
  constexpr int kIntervals = 720;
  constexpr double kReach = 5;  // standard deviations
  if (single_angle(a)) return visit(a.mean_deg, 1.0);
  const double half = a.sd_deg > 0 ? kReach : a.spread_deg;
  double sum = 0;
  const auto weight = [&](double x) { return a.sd_deg > 0 ? portable_exp(-x * x / 2) : 1; };
  const auto place = [&](int i) { return half * ((2 * i + 1.0) / kIntervals - 1); };
  for (int i = 0; i < kIntervals; ++i) sum += weight(place(i));
  for (int i = 0; i < kIntervals; ++i)
    visit(a.mean_deg + place(i) * (a.sd_deg > 0 ? a.sd_deg : 1), weight(place(i)) / sum);
}

}  // namespace

bool are_cut(const StrandStatistics& strands, const AngleDistribution& angles) {
  return strands.width_mm > 0 && !all_along(angles) && !all_across(angles);
}

StrandStatistics in_section(const StrandStatistics& strands, const AngleDistribution& angles) {
  auto shown = strands;
  shown.width_mm = shown.width_sd_mm = 0;
  if (!(strands.width_mm > 0) || all_along(angles)) return shown;
  if (all_across(angles)) {
    shown.length_mm = strands.width_mm;
    shown.length_sd_mm = strands.width_sd_mm;
    return shown;
  }
  double extent = 0, square = 0;
  over_angles(angles, [&](double angle_deg, double share) {
    const Trapezoid strand(strands.length_mm, strands.width_mm, angle_deg);
    extent += share * strand.extent;
    square += share * strand.integral_of_square();
  });
  const double mean = strands.length_mm * strands.width_mm / extent;
  shown.length_mm = mean;
  shown.length_sd_mm = std::sqrt(std::max(0.0, square / extent - mean * mean));
  return shown;
}

CutSource::CutSource(const StrandStatistics& strands, const AngleDistribution& angles)
    : strands_(strands), angles_(angles) {
  const double length = strands.length_mm + kNormalLimit * strands.length_sd_mm;
  const double width = strands.width_mm + kNormalLimit * strands.width_sd_mm;
  longest_ = std::sqrt(length * length + width * width);
}

CutSource::Cut CutSource::draw(RandomStream& random) const {
  for (;;) {
    const double length = random.positive_normal(strands_.length_mm, strands_.length_sd_mm);
    const double width = random.positive_normal(strands_.width_mm, strands_.width_sd_mm);
    const double angle_deg = angles_.draw(random);
    const Trapezoid strand(length, width, angle_deg);
    if (random.uniform() * longest_ < strand.extent)  // no extent is longer than the diagonal either
      return {strand.cut(random.uniform() * strand.extent), angle_deg};
  }
}

}  // namespace strandlab::mat
