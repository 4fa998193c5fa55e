#include "strandlab/vtest/plate_connection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

#include "strandlab/core/eigenvalues.hpp"
#include "strandlab/vtest/specimen.hpp"

namespace strandlab::vtest {
namespace {

using Points = std::vector<glue::GluePoint<3>>;
using Windows = std::array<int, 2>;  // whole periods along x and y

// Marks the strands that glue points to strands which are still held keep from moving as rigid bodies: points that are
// fixed in space would. Those that are not held may leave others without hold.
std::vector<bool> held_strands(const Panel<3>& panel, const Points& points) {
  constexpr double kLoose = 1e-9;  // smallest resistance to a rigid motion over the largest
  std::vector<std::vector<std::size_t>> of_strand(panel.strands.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    of_strand[static_cast<std::size_t>(points[p].a.strand)].push_back(p);
    of_strand[static_cast<std::size_t>(points[p].b.strand)].push_back(p);
  }
  std::vector<bool> held(panel.strands.size(), true);
  const auto is_held = [&](std::size_t s) {
    const auto& lattice = panel.strands[s].lattice;
    const double size = std::max(lattice.extent(0), lattice.extent(1));
    Eigen::Matrix<double, 6, 6> resistance = Eigen::Matrix<double, 6, 6>::Zero();
    Vec<3> middle = Vec<3>::Zero();
    for (const auto& x : panel.strands[s].points.x) middle += x / static_cast<double>(panel.strands[s].size());
    for (const auto p : of_strand[s]) {
      const bool lower = static_cast<std::size_t>(points[p].a.strand) == s;
      const auto& other = lower ? points[p].b : points[p].a;
      if (!held[static_cast<std::size_t>(other.strand)] || static_cast<std::size_t>(other.strand) == s) continue;
      Vec<3> arm = ((lower ? points[p].a : points[p].b).position - middle) / size;
      if (!lower) {
        arm[0] -= points[p].b.image[0] * panel.length_mm / size;
        arm[1] -= points[p].b.image[1] * panel.depth_mm / size;
      }
      Eigen::Matrix<double, 3, 6> motion;  // of the point, by translation and rotation
      motion << Tensor<3>::Identity(),
          (Tensor<3>() << 0, arm[2], -arm[1], -arm[2], 0, arm[0], arm[1], -arm[0], 0).finished();
      resistance += motion.transpose() * motion;
    }
    const auto modes = eigenvalues(resistance);
    return modes[0] > kLoose * std::max(modes[5], 1e-300);
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t s = 0; s < held.size(); ++s) {
      if (!held[s] || is_held(s)) continue;
      held[s] = false;
      changed = true;
    }
  }
  return held;
}

// A piece that glue holds together: its strands, and the ways around the torus within it that end a number of windows
// from where they began.
struct Piece {
  std::vector<int> strands;
  std::vector<Windows> around;
};

std::vector<Piece> pieces(const Panel<3>& panel, const Points& points, const std::vector<bool>& held) {
  struct Edge {
    int to;
    Windows shift;
  };
  std::vector<std::vector<Edge>> edges(panel.strands.size());
  for (const auto& point : points) {
    const int a = point.a.strand, b = point.b.strand;
    if (!held[static_cast<std::size_t>(a)] || !held[static_cast<std::size_t>(b)]) continue;
    const auto [i, j] = point.b.image;
    edges[static_cast<std::size_t>(a)].push_back({b, {i, j}});
    edges[static_cast<std::size_t>(b)].push_back({a, {-i, -j}});
  }
  std::vector<Piece> found;
  std::vector<char> seen(panel.strands.size(), 0);
  std::vector<Windows> place(panel.strands.size());
  for (std::size_t s = 0; s < seen.size(); ++s) {
    if (seen[s] || !held[s]) continue;
    auto& piece = found.emplace_back();
    std::deque<int> next{static_cast<int>(s)};
    seen[s] = 1;
    while (!next.empty()) {
      const int here = next.front();
      next.pop_front();
      piece.strands.push_back(here);
      for (const auto& [to, shift] : edges[static_cast<std::size_t>(here)]) {
        const auto& from = place[static_cast<std::size_t>(here)];
        const Windows there{from[0] + shift[0], from[1] + shift[1]};
        auto& known = place[static_cast<std::size_t>(to)];
        if (!seen[static_cast<std::size_t>(to)]) {
          seen[static_cast<std::size_t>(to)] = 1;
          known = there;
          next.push_back(to);
        } else if (there != known) {
          piece.around.push_back({there[0] - known[0], there[1] - known[1]});
        }
      }
    }
  }
  return found;
}

double volume(const Panel<3>& panel, const Piece& piece) {
  double sum = 0;
  for (const int s : piece.strands) {
    const auto& lattice = panel.strands[static_cast<std::size_t>(s)].lattice;
    sum += lattice.point_volume() * static_cast<double>(lattice.size());
  }
  return sum;
}

void see_around(const Piece& piece, PlateConnection& connection) {
  for (const auto& [i, j] : piece.around) {
    connection.across_x = connection.across_x || i != 0;
    connection.across_y = connection.across_y || j != 0;
    const auto& first = piece.around.front();
    connection.across_both = connection.across_both || first[0] * j != first[1] * i;
  }
}

void see_ends(const Panel<3>& panel, const Piece& piece, PlateConnection& connection) {
  Vec<2> low(panel.length_mm, panel.depth_mm), high = Vec<2>::Zero();
  Vec<2> tolerance = Vec<2>::Zero();
  for (const int s : piece.strands) {
    const auto& strand = panel.strands[static_cast<std::size_t>(s)];
    for (const auto& corner : corners(strand)) {
      low = low.cwiseMin(corner.head<2>());
      high = high.cwiseMax(corner.head<2>());
    }
    tolerance = tolerance.cwiseMax(kCreep * strand.lattice.spacing.head<2>());
  }
  connection.across_x = low[0] < tolerance[0] && high[0] > panel.length_mm - tolerance[0];
  connection.across_y = low[1] < tolerance[1] && high[1] > panel.depth_mm - tolerance[1];
  connection.across_both = connection.across_x && connection.across_y;
}

}  // namespace

PlateConnection connect(const Panel<3>& panel, const std::vector<glue::GluePoint<3>>& points) {
  PlateConnection connection;
  connection.kept.assign(panel.strands.size(), false);
  connection.floating = static_cast<int>(panel.strands.size());
  const auto found = pieces(panel, points, held_strands(panel, points));
  if (found.empty()) return connection;
  const auto& largest = *std::max_element(
      found.begin(), found.end(), [&](const Piece& a, const Piece& b) { return volume(panel, a) < volume(panel, b); });
  for (const int s : largest.strands) connection.kept[static_cast<std::size_t>(s)] = true;
  connection.floating -= static_cast<int>(largest.strands.size());
  panel.periodic ? see_around(largest, connection) : see_ends(panel, largest, connection);
  return connection;
}

}  // namespace strandlab::vtest
