// Convex polygons in a plane, cut by half-planes: exactly, and so continuously as their edges move.
#pragma once

#include <vector>

#include "strandlab/core/types.hpp"

namespace strandlab {

// Corners counter-clockwise; fewer than three: nothing is left.
using Polygon = std::vector<Vec<2>>;

// Where offset + slope.x >= 0.
struct HalfPlane {
  double offset = 0;
  Vec<2> slope = Vec<2>::Zero();
  double at(const Vec<2>& x) const { return offset + slope.dot(x); }
  HalfPlane complement() const { return {-offset, -slope}; }
};

// The part of a polygon in a half-plane.
Polygon cut(const Polygon& polygon, const HalfPlane& kept);

// What is left of a polygon without the common part of half-planes, in convex pieces.
std::vector<Polygon> without(const Polygon& polygon, const std::vector<HalfPlane>& removed);

// Area, and area times centroid.
struct Moments {
  double area = 0;
  Vec<2> first = Vec<2>::Zero();
};
Moments moments(const Polygon& polygon);

}  // namespace strandlab
