#include "strandlab/core/polygon.hpp"

namespace strandlab {

Polygon cut(const Polygon& polygon, const HalfPlane& kept) {
  Polygon left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double before = kept.at(from), after = kept.at(to);
    if (before >= 0) left.push_back(from);
    if ((before > 0 && after < 0) || (before < 0 && after > 0)) {
      left.emplace_back(from + before / (before - after) * (to - from));
    }
  }
  return left;
}

std::vector<Polygon> without(const Polygon& polygon, const std::vector<HalfPlane>& removed) {
  std::vector<Polygon> pieces;
  auto rest = polygon;
  for (const auto& half : removed) {
    if (auto piece = cut(rest, half.complement()); moments(piece).area > 0) pieces.push_back(std::move(piece));
    rest = cut(rest, half);
  }
  return pieces;
}

Moments moments(const Polygon& polygon) {
  Moments sum;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec<2> p = polygon[i] - polygon[0], q = polygon[i + 1] - polygon[0];
    const double triangle = 0.5 * (p[0] * q[1] - p[1] * q[0]);
    sum.area += triangle;
    sum.first += triangle * (polygon[0] + (p + q) / 3);
  }
  return sum;
}

}  // namespace strandlab
