// The domain of a material point, x +- F spacing/2, cut by planes across an axis. Mass is spread evenly over it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "strandlab/panel/panel.hpp"

namespace strandlab::profile {

// Lengths along an axis, mm, that the edges of a point's domain span: |F_axis,a spacing_a| of every axis a, the largest
// first. Heights are those along the last axis.
template <int Dim>
std::array<double, Dim> spans(const Tensor<Dim>& F, const Vec<Dim>& spacing, int axis) {
  std::array<double, Dim> h{};
  for (int a = 0; a < Dim; ++a) h[static_cast<std::size_t>(a)] = std::abs(F(axis, a) * spacing[a]);
  std::sort(h.begin(), h.end(), [](double a, double b) { return a > b; });
  return h;
}
template <int Dim>
std::array<double, Dim> heights(const Tensor<Dim>& F, const Vec<Dim>& spacing) {
  return spans<Dim>(F, spacing, Dim - 1);
}

// Part of a parallelogram, whose edges span the heights tall >= small, that lies below the height z over its centre:
// the ends are triangles, the middle has an even width.
inline double part_below(double tall, double small, double z) {
  if (z > 0) return 1 - part_below(tall, small, -z);
  const double end = z + 0.5 * (tall + small);
  if (end <= 0) return 0;
  return end < small ? end * end / (2 * tall * small) : std::min(0.5, 0.5 + z / tall);
}

// The same of a point's domain in two or three dimensions. A parallelepiped is a pile of parallelograms: its part is
// their mean over the height that the third edge spans, piece by piece between the kinks of part_below(), each a
// quadratic that two Gauss points integrate exactly.
template <int Dim>
double part_below(const std::array<double, Dim>& heights, double z) {
  const double tall = heights[0], small = heights[1];
  if constexpr (Dim == 2) {
    return part_below(tall, small, z);
  } else {
    const double low = z - 0.5 * heights[2], high = z + 0.5 * heights[2];
    if (!(high > low)) return part_below(tall, small, z);
    const double outer = 0.5 * (tall + small), inner = 0.5 * (tall - small);
    std::array<double, 7> kinks{low, -outer, -inner, 0, inner, outer, high};
    for (auto& kink : kinks) kink = std::clamp(kink, low, high);
    double sum = 0;
    for (std::size_t k = 0; k + 1 < kinks.size(); ++k) {
      const double half = 0.5 * (kinks[k + 1] - kinks[k]), middle = 0.5 * (kinks[k + 1] + kinks[k]);
      const double gauss = half / std::sqrt(3.0);
      sum += half * (part_below(tall, small, middle - gauss) + part_below(tall, small, middle + gauss));
    }
    return sum / (high - low);
  }
}

}  // namespace strandlab::profile
