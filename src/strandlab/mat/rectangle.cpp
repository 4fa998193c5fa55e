#include "strandlab/mat/rectangle.hpp"

#include <algorithm>
#include <cmath>

#include "strandlab/core/elementary.hpp"

namespace strandlab::mat {
namespace {

double circumradius(const Rectangle& r) {
  return std::sqrt(r.half_length * r.half_length + r.half_width * r.half_width);
}

// Whole numbers k for which |distance + k period| <= reach.
struct Span {
  int first = 0, last = 0;
};
Span within_reach(double distance, double period, double reach) {
  return {static_cast<int>(std::ceil((-reach - distance) / period)),
          static_cast<int>(std::floor((reach - distance) / period))};
}

template <class Visit>
std::optional<Image> first_image(double clearance, const Rectangle& a, const Rectangle& b, const Window& window,
                                 Visit is_another) {
  if (!window.periodic) {
    if (is_another(0, 0) && distance_apart(a, b) < clearance) return Image{};
    return {};
  }
  const double reach = circumradius(a) + circumradius(b) + clearance;
  const Span along = within_reach(b.cx - a.cx, window.x, reach), across = within_reach(b.cy - a.cy, window.y, reach);
  for (int i = along.first; i <= along.last; ++i) {
    for (int j = across.first; j <= across.last; ++j) {
      if (is_another(i, j) && distance_apart(a, b, i * window.x, j * window.y) < clearance) return Image{i, j};
    }
  }
  return {};
}

}  // namespace

Rectangle rectangle(double cx_mm, double cy_mm, double length_mm, double width_mm, double angle_deg) {
  const auto direction = cos_sin_degrees(angle_deg);
  return {cx_mm, cy_mm, 0.5 * length_mm, 0.5 * width_mm, direction.cos, direction.sin};
}

double distance_apart(const Rectangle& a, const Rectangle& b, double dx, double dy) {
  const double x = b.cx + dx - a.cx, y = b.cy + dy - a.cy;
  const double c = std::abs(a.cos * b.cos + a.sin * b.sin), s = std::abs(a.cos * b.sin - a.sin * b.cos);
  const double along_a = std::abs(x * a.cos + y * a.sin) - a.half_length - (b.half_length * c + b.half_width * s);
  const double across_a = std::abs(y * a.cos - x * a.sin) - a.half_width - (b.half_length * s + b.half_width * c);
  const double along_b = std::abs(x * b.cos + y * b.sin) - b.half_length - (a.half_length * c + a.half_width * s);
  const double across_b = std::abs(y * b.cos - x * b.sin) - b.half_width - (a.half_length * s + a.half_width * c);
  return std::max(std::max(along_a, across_a), std::max(along_b, across_b));
}

std::optional<Image> image_within(double clearance, const Rectangle& a, const Rectangle& b, const Window& window) {
  return first_image(clearance, a, b, window, [](int, int) { return true; });
}

std::optional<Image> own_image_within(double clearance, const Rectangle& a, const Window& window) {
  return first_image(clearance, a, a, window, [](int i, int j) { return i != 0 || j != 0; });
}

}  // namespace strandlab::mat
