// The lattice of a strand's material points, and every index sum that follows from it: points, cells, corners, faces,
// places in between, parts of it. Nothing else in the program adds up indices of a strand.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "strandlab/core/types.hpp"

namespace strandlab {

// Zero, whatever the type of a field's values.
template <class Value>
Value zero_of() {
  if constexpr (std::is_arithmetic_v<Value>) {
    return 0;
  } else {
    return Value::Zero();
  }
}

// Face of a lattice: where the numbers of one axis are lowest (end 0) or highest (end 1).
struct LatticeFace {
  int axis = 0, end = 0;
  const char* name = "";
};

// counts[0] x counts[1] (x counts[2]) material points: along the strand, [across it,] through its thickness. A point is
// the middle of its cell; the corners of the cells are one more than the points on each axis. Points and corners are
// numbered along the strand first, rows stack through the thickness: all arrays of points or corners have that order.
// A coordinate on the lattice is measured in points: corner i of an axis is at i, point i at i + 1/2.
template <int Dim>
struct Lattice {
  using Place = std::array<int, Dim>;

  Place counts{};                       // of the points, by axis
  Vec<Dim> spacing = Vec<Dim>::Zero();  // mm, of the points at formation: length = counts[0] * spacing[0], exactly

  std::size_t size() const { return product(0); }  // points, and cells
  std::size_t corner_count() const { return product(1); }
  double extent(int axis) const { return counts[axis] * spacing[axis]; }  // mm, at formation
  double thickness() const { return extent(Dim - 1); }                    // mm, at formation
  double point_volume() const { return spacing.prod(); }                  // mm^3 (2D: per mm of depth), at formation

  // Number of the point at a place, and the place of a point; the same for corners.
  std::size_t point(const Place& place) const { return number(place, 0); }
  Place place_of_point(std::size_t point) const { return place(point, 0); }
  std::size_t corner(const Place& place) const { return number(place, 1); }
  Place place_of_corner(std::size_t corner) const { return place(corner, 1); }

  // Corners of a point's cell: counter-clockwise, in 3D those of its lower face, then those above them.
  std::array<std::size_t, 1U << Dim> cell(std::size_t point) const;

  // Points and corners of a face, in their order.
  std::vector<std::size_t> face_points(const LatticeFace& face) const { return on_face(face, 0); }
  std::vector<std::size_t> face_corners(const LatticeFace& face) const { return on_face(face, 1); }

  // Value at a coordinate, between those at the corners (linear along each axis); beyond the ends it goes on as in the
  // last cell.
  template <class Value>
  Value between_corners(const std::vector<Value>& at_corners, const Vec<Dim>& coordinate) const;

 private:
  // `more` is 0 for points, 1 for corners.
  std::size_t product(int more) const;
  std::size_t number(const Place& place, int more) const;
  Place place(std::size_t number, int more) const;
  std::vector<std::size_t> on_face(const LatticeFace& face, int more) const;
};

template <int Dim>
inline constexpr LatticeFace kBottom{Dim - 1, 0, "bottom"};
template <int Dim>
inline constexpr LatticeFace kTop{Dim - 1, 1, "top"};
inline constexpr LatticeFace kLeftEnd{0, 0, "left end"}, kRightEnd{0, 1, "right end"};
inline constexpr LatticeFace kNearEdge{1, 0, "near edge"}, kFarEdge{1, 1, "far edge"};  // 3D

// All faces of a lattice.
template <int Dim>
constexpr std::array<LatticeFace, 2 * Dim> lattice_faces() {
  if constexpr (Dim == 2) {
    return {kBottom<2>, kTop<2>, kLeftEnd, kRightEnd};
  } else {
    return {kBottom<3>, kTop<3>, kNearEdge, kFarEdge, kLeftEnd, kRightEnd};
  }
}

// Cells that an extent is divided into to be about as long as `cell` (mm): at least one.
inline int divisions(double extent, double cell) {
  return std::max(1, static_cast<int>(std::lround(extent / cell)));
}

// The corners around a section's lattice, counter-clockwise from the first.
std::vector<std::size_t> outline(const Lattice<2>& lattice);

// Values at the corners of a lattice: each the mean of what the adjacent points say of it. say(point, offset) is a
// point's word on the corner of its cell that lies `offset` from it (mm, at formation, in the lattice's axes).
template <int Dim, class Say>
auto corner_means(const Lattice<Dim>& lattice, const Say& say) {
  using Value = std::decay_t<decltype(say(std::size_t{}, lattice.spacing))>;
  constexpr unsigned kCellCorners = 1U << static_cast<unsigned>(Dim);
  std::vector<Value> sum(lattice.corner_count(), zero_of<Value>());
  std::vector<int> count(sum.size(), 0);
  for (std::size_t p = 0; p < lattice.size(); ++p) {
    const auto place = lattice.place_of_point(p);
    for (unsigned k = 0; k < kCellCorners; ++k) {
      auto at = place;
      Vec<Dim> offset;
      for (int a = 0; a < Dim; ++a) {
        const int end = static_cast<int>(k >> static_cast<unsigned>(a) & 1U);
        at[a] += end;
        offset[a] = (end - 0.5) * lattice.spacing[a];
      }
      const auto c = lattice.corner(at);
      sum[c] += say(p, offset);
      ++count[c];
    }
  }
  for (std::size_t c = 0; c < sum.size(); ++c) sum[c] /= count[c];
  return sum;
}

// Part of one axis of a lattice, from..to in points: the points first..end-1 that it covers, each by weight(p) of its
// width. The weights of the parts of an axis add up to 1 for every point.
struct Cover {
  Cover(double part_from, double part_to, int count)
      : from(part_from),
        to(part_to),
        first(std::max(0, static_cast<int>(std::floor(part_from)))),
        end(std::min(count, static_cast<int>(std::ceil(part_to)))) {}
  double weight(int p) const { return std::max(0.0, std::min(to, p + 1.0) - std::max(from, static_cast<double>(p))); }

  double from, to;
  int first, end;
};

// visit(point, weight) for every point that the box from..to (coordinates) covers; weights in cells.
template <int Dim, class Visit>
void for_each_covered(const Lattice<Dim>& lattice, const Vec<Dim>& from, const Vec<Dim>& to, const Visit& visit) {
  const auto cover = [&](int axis) { return Cover(from[axis], to[axis], lattice.counts[axis]); };
  const Cover along = cover(0), through = cover(Dim - 1);
  for (int k = through.first; k < through.end; ++k) {
    if constexpr (Dim == 2) {
      for (int i = along.first; i < along.end; ++i) {
        visit(lattice.point({i, k}), along.weight(i) * through.weight(k));
      }
    } else {
      const Cover across = cover(1);
      for (int j = across.first; j < across.end; ++j) {
        for (int i = along.first; i < along.end; ++i) {
          visit(lattice.point({i, j, k}), along.weight(i) * across.weight(j) * through.weight(k));
        }
      }
    }
  }
}

// Where a lattice lies in the panel as formed: its first corner, and its axes as the columns of a rotation. A section's
// lattices stand upright; those of a 3D panel are turned in its plane. Positions are those of the whole strand: on a
// periodic window they go on beyond its edge and are never wrapped, so that no strand is cut.
template <int Dim>
struct Placement {
  Vec<Dim> corner = Vec<Dim>::Zero();  // mm
  Tensor<Dim> axes = Tensor<Dim>::Identity();
};

// The lattice's middle at `centre` (mm), its first axis turned by an angle from x towards y. Quarter turns are exact.
Placement<3> turned(const Lattice<3>& lattice, const Vec<3>& centre, double angle_deg);

// Positions of the points, mm.
template <int Dim>
std::vector<Vec<Dim>> positions(const Lattice<Dim>& lattice, const Placement<Dim>& placement) {
  std::vector<Vec<Dim>> x;
  x.reserve(lattice.size());
  for (std::size_t p = 0; p < lattice.size(); ++p) {
    const auto place = lattice.place_of_point(p);
    Vec<Dim> local;
    for (int a = 0; a < Dim; ++a) local[a] = (place[a] + 0.5) * lattice.spacing[a];
    x.emplace_back(placement.corner + placement.axes * local);
  }
  return x;
}

template <int Dim>
std::size_t Lattice<Dim>::product(int more) const {
  std::size_t n = 1;
  for (const int count : counts) n *= static_cast<std::size_t>(count + more);
  return n;
}

template <int Dim>
std::size_t Lattice<Dim>::number(const Place& place, int more) const {
  std::size_t n = 0;
  for (int a = Dim - 1; a >= 0; --a)
    n = n * static_cast<std::size_t>(counts[a] + more) + static_cast<std::size_t>(place[a]);
  return n;
}

template <int Dim>
typename Lattice<Dim>::Place Lattice<Dim>::place(std::size_t number, int more) const {
  Place place{};
  for (int a = 0; a < Dim; ++a) {
    const auto count = static_cast<std::size_t>(counts[a] + more);
    place[a] = static_cast<int>(number % count);
    number /= count;
  }
  return place;
}

template <int Dim>
std::array<std::size_t, 1U << Dim> Lattice<Dim>::cell(std::size_t point) const {
  auto at = place_of_point(point);
  std::array<std::size_t, 1U << Dim> corners{};
  auto next = corners.begin();
  for (int level = 0; level < Dim - 1; ++level) {
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      auto place = at;
      place[0] += i;
      place[1] += j;
      *next++ = corner(place);
    }
    ++at[Dim - 1];
  }
  return corners;
}

template <int Dim>
std::vector<std::size_t> Lattice<Dim>::on_face(const LatticeFace& face, int more) const {
  std::vector<std::size_t> numbers;
  const int fixed = face.end == 0 ? 0 : counts[face.axis] + more - 1;
  for (std::size_t n = 0; n < product(more); ++n) {
    if (place(n, more)[face.axis] == fixed) numbers.push_back(n);
  }
  return numbers;
}

template <int Dim>
template <class Value>
Value Lattice<Dim>::between_corners(const std::vector<Value>& at_corners, const Vec<Dim>& coordinate) const {
  Place low{};
  for (int a = 0; a < Dim; ++a) low[a] = std::clamp(static_cast<int>(coordinate[a]), 0, counts[a] - 1);
  std::array<Value, 1U << Dim> values;
  for (unsigned k = 0; k < values.size(); ++k) {
    auto at = low;
    for (int a = 0; a < Dim; ++a) at[a] += static_cast<int>(k >> static_cast<unsigned>(a) & 1U);
    values[k] = at_corners[corner(at)];
  }
  for (int a = 0, left = 1 << (Dim - 1); a < Dim; ++a, left /= 2) {  // axis by axis half of the values are left
    const double f = coordinate[a] - low[a];
    for (int k = 0; k < left; ++k) values[k] = (1 - f) * values[2 * k] + f * values[2 * k + 1];
  }
  return values[0];
}

}  // namespace strandlab
