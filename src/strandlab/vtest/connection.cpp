#include "strandlab/vtest/connection.hpp"

#include <numeric>

#include "strandlab/vtest/window.hpp"

namespace strandlab::vtest {
namespace {

// Mean x of one of the strand's ends.
double end_position(const Strand<2>& strand, const LatticeFace& end) {
  const auto position = corners(strand);
  const auto at_end = strand.lattice.face_corners(end);
  double sum = 0;
  for (const auto c : at_end) sum += position[c][0];
  return sum / static_cast<double>(at_end.size());
}

int root(std::vector<int>& parent, int s) {
  while (parent[s] != s) s = parent[s] = parent[parent[s]];
  return s;
}

}  // namespace

Connection connect(const Panel<2>& panel, const std::vector<glue::GluePoint<2>>& points) {
  const auto n = panel.strands.size();
  Connection connection;
  for (const auto& strand : panel.strands) {
    const double tolerance = kCreep * strand.lattice.spacing[0];
    connection.at_left.push_back(end_position(strand, kLeftEnd) < tolerance);
    connection.at_right.push_back(end_position(strand, kRightEnd) > panel.length_mm - tolerance);
  }
  std::vector<int> parent(n);
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto& point : points) parent[root(parent, point.a.strand)] = root(parent, point.b.strand);

  std::vector<char> left(n, 0), right(n, 0);
  for (std::size_t s = 0; s < n; ++s) {
    const int r = root(parent, static_cast<int>(s));
    if (connection.at_left[s]) left[r] = 1;
    if (connection.at_right[s]) right[r] = 1;
  }
  std::vector<int> number(n, -1);
  connection.group.assign(n, -1);
  for (std::size_t s = 0; s < n; ++s) {
    const int r = root(parent, static_cast<int>(s));
    if (left[r] && right[r]) {
      if (number[r] < 0) number[r] = connection.groups++;
      connection.group[s] = number[r];
    } else {
      ++connection.floating;
    }
  }
  return connection;
}

}  // namespace strandlab::vtest
