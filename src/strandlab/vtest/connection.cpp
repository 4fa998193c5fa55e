#include "strandlab/vtest/connection.hpp"

#include <algorithm>
#include <numeric>

#include "strandlab/vtest/specimen.hpp"

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

bool can_connect(const Panel<2>& mat, double compaction) {
  struct Reach {
    double low, high;  // mm, in plan
    int row;
    std::size_t strand;
  };
  const auto n = mat.strands.size();
  std::vector<Reach> reaches;
  std::vector<char> left(n, 0), right(n, 0);
  for (std::size_t s = 0; s < n; ++s) {
    const auto& strand = mat.strands[s];
    const double length = strand.lattice.extent(0);
    const double x0 = strand.points.x.front()[0] - 0.5 * strand.lattice.spacing[0];
    const double more = length * compaction / (1 - compaction) + mat.initial_thickness_mm;
    reaches.push_back({x0 - more, x0 + length + more, strand.row, s});
    left[s] = (s == 0 || mat.strands[s - 1].row != strand.row) && reaches[s].low <= 0;
    right[s] = (s + 1 == n || mat.strands[s + 1].row != strand.row) && reaches[s].high >= mat.length_mm;
  }
  std::sort(reaches.begin(), reaches.end(), [](const Reach& a, const Reach& b) { return a.low < b.low; });
  std::vector<int> parent(n);
  std::iota(parent.begin(), parent.end(), 0);
  std::vector<Reach> open;  // those that reach as far as the one at hand begins
  for (const auto& reach : reaches) {
    std::erase_if(open, [&](const Reach& other) { return other.high < reach.low; });
    for (const auto& other : open) {
      if (other.row != reach.row)
        parent[root(parent, static_cast<int>(other.strand))] = root(parent, static_cast<int>(reach.strand));
    }
    open.push_back(reach);
  }
  std::vector<char> from_left(n, 0);
  for (std::size_t s = 0; s < n; ++s) {
    if (left[s]) from_left[root(parent, static_cast<int>(s))] = 1;
  }
  for (std::size_t s = 0; s < n; ++s) {
    if (right[s] && from_left[root(parent, static_cast<int>(s))]) return true;
  }
  return false;
}

}  // namespace strandlab::vtest
