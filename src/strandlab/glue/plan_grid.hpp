// Which boxes lie over one another in plan: a uniform grid of bins, on a torus where the window is periodic.
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "strandlab/core/types.hpp"

namespace strandlab::glue {

struct PlanBox {
  Vec<2> low, high;  // mm
};

// A box, shifted by whole periods of the window along x and y.
struct BoxImage {
  int box = 0;
  std::array<int, 2> image{};
  bool operator==(const BoxImage&) const = default;
  bool operator<(const BoxImage& other) const { return std::tie(box, image) < std::tie(other.box, other.image); }
};

class PlanGrid {
 public:
  // `period` (mm): of the window 0..period along x and y; 0: no images.
  PlanGrid(std::vector<PlanBox> boxes, const Vec<2>& period);

  // Images of the boxes that overlap this one or touch it, each once, in order.
  std::vector<BoxImage> over(const PlanBox& box) const;

 private:
  struct Range {
    std::array<int, 2> first, last;  // bins, counted on beyond the window's edges
  };
  Range range(const PlanBox& box) const;
  // Index of a bin, and the period in which it lies.
  std::size_t wrap(const std::array<int, 2>& bin, std::array<int, 2>& period) const;

  std::vector<PlanBox> boxes_;
  Vec<2> period_;
  Vec<2> origin_ = Vec<2>::Zero(), size_;  // of the bins, mm
  std::array<int, 2> counts_{};
  std::vector<std::vector<BoxImage>> bins_;  // a box that lies in a bin, and the period of that bin as the box sees it
};

}  // namespace strandlab::glue
