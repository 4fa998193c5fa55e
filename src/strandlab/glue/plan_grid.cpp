#include "strandlab/glue/plan_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace strandlab::glue {
namespace {

bool touch(const PlanBox& a, const PlanBox& b, const Vec<2>& shift_of_b) {
  return ((a.low - shift_of_b - b.high).array() <= 0).all() && ((b.low + shift_of_b - a.high).array() <= 0).all();
}

}  // namespace

PlanGrid::PlanGrid(std::vector<PlanBox> boxes, const Vec<2>& period) : boxes_(std::move(boxes)), period_(period) {
  constexpr double kBinsPerBox = 2, kMostBins = 256;  // along an axis
  Vec<2> mean = Vec<2>::Zero(), low = Vec<2>::Zero(), high = Vec<2>::Zero();
  for (std::size_t k = 0; k < boxes_.size(); ++k) {
    const auto& box = boxes_[k];
    mean += (box.high - box.low) / static_cast<double>(boxes_.size());
    low = k == 0 ? box.low : Vec<2>(low.cwiseMin(box.low));
    high = k == 0 ? box.high : Vec<2>(high.cwiseMax(box.high));
  }
  const bool periodic = (period_.array() > 0).all();
  const Vec<2> extent = periodic ? period_ : Vec<2>(high - low);
  if (!periodic) origin_ = low;
  for (int a = 0; a < 2; ++a) {
    const double bins = mean[a] > 0 ? kBinsPerBox * extent[a] / mean[a] : 1;
    counts_[static_cast<std::size_t>(a)] = static_cast<int>(std::clamp(bins, 1.0, kMostBins));
    size_[a] = extent[a] / counts_[static_cast<std::size_t>(a)];
  }
  bins_.resize(static_cast<std::size_t>(counts_[0]) * static_cast<std::size_t>(counts_[1]));
  for (std::size_t k = 0; k < boxes_.size(); ++k) {
    const auto [first, last] = range(boxes_[k]);
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int i = first[0]; i <= last[0]; ++i) {
        BoxImage entry{static_cast<int>(k), {}};
        const auto bin = wrap({i, j}, entry.image);
        bins_[bin].push_back(entry);
      }
    }
  }
}

PlanGrid::Range PlanGrid::range(const PlanBox& box) const {
  Range range{};
  const bool periodic = (period_.array() > 0).all();
  for (std::size_t a = 0; a < 2; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const auto bin = [&](double x) {
      const int number = size_[axis] > 0 ? static_cast<int>(std::floor((x - origin_[axis]) / size_[axis])) : 0;
      return periodic ? number : std::clamp(number, 0, counts_[a] - 1);
    };
    range.first[a] = bin(box.low[axis]);
    range.last[a] = bin(box.high[axis]);
  }
  return range;
}

std::size_t PlanGrid::wrap(const std::array<int, 2>& bin, std::array<int, 2>& period) const {
  std::array<int, 2> within{};
  for (std::size_t a = 0; a < 2; ++a) {
    within[a] = (bin[a] % counts_[a] + counts_[a]) % counts_[a];
    period[a] = (bin[a] - within[a]) / counts_[a];
  }
  return static_cast<std::size_t>(within[0]) +
         static_cast<std::size_t>(counts_[0]) * static_cast<std::size_t>(within[1]);
}

std::vector<BoxImage> PlanGrid::over(const PlanBox& box) const {
  std::vector<BoxImage> found;
  const auto [first, last] = range(box);
  for (int j = first[1]; j <= last[1]; ++j) {
    for (int i = first[0]; i <= last[0]; ++i) {
      std::array<int, 2> here{};
      const auto bin = wrap({i, j}, here);
      for (const auto& entry : bins_[bin]) {
        const BoxImage image{entry.box, {here[0] - entry.image[0], here[1] - entry.image[1]}};
        const Vec<2> shift(image.image[0] * period_[0], image.image[1] * period_[1]);
        if (touch(box, boxes_[static_cast<std::size_t>(entry.box)], shift)) found.push_back(image);
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace strandlab::glue
