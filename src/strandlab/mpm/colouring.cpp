#include "strandlab/mpm/colouring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "strandlab/mpm/checks.hpp"
#include "strandlab/mpm/fields.hpp"

namespace strandlab::mpm {
namespace {

using Node = std::array<int, 3>;  // lateral axes, row

// Calls visit(which, position) for the points of a tile. `which`: 0 the particles, 1 and 2 their images in the bottom
// and top platen, from 3 on the points of each face; points of different sorts have records of their own.
template <int Dim, class Visit>
void each_point(const Tile& tile, const Particles<Dim>& body, const Step<Dim>& step, Visit visit) {
  for (int b = tile.block_begin; b < tile.block_end; ++b) {
    for (int l = 0; l < body.lanes[b]; ++l) {
      Vec<Dim> x = body.position(body.block(b) + l);
      visit(0, x);
      const double height = x[Dim - 1];
      for (int k = 0; k < 2 && step.platen[k].present; ++k) {
        if (std::abs(height - step.platen[k].position) > (kMirrorDepth + 1) * step.cell[Dim - 1]) continue;
        x[Dim - 1] = 2 * step.platen[k].position - height;
        visit(1 + k, x);
      }
    }
  }
  for (std::size_t k = 0; k < body.faces.size(); ++k) {
    const auto& face = body.faces[k];
    for (int i = tile.face_begin[k] * kBlock; i < tile.face_end[k] * kBlock; ++i) {
      const double* d = body.data.data() + face.where[i];
      Vec<Dim> offset;
      for (int a = 0; a < Dim; ++a) offset[a] = face.offset[(i / kBlock * Dim + a) * kBlock + i % kBlock];
      visit(3 + static_cast<int>(k), Vec<Dim>(body.position(d) + body.deformation(d) * offset));
    }
  }
}

struct Box {  // of nodes, lateral axes
  std::array<int, 2> first, last;
  bool meets(const Box& other) const {
    for (int a = 0; a < 2; ++a) {
      if (last[a] < other.first[a] || other.last[a] < first[a]) return false;
    }
    return true;
  }
};

template <int Dim>
Box box_of(const Tile& tile, const Particles<Dim>& body, const Step<Dim>& step) {
  Vec<Dim> low = Vec<Dim>::Constant(1e300), high = -low;
  each_point<Dim>(tile, body, step, [&](int, const Vec<Dim>& x) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  });
  const auto from = nearest_nodes<Dim>(low, step)[0], to = nearest_nodes<Dim>(high, step)[1];
  constexpr int kReach = Extents::kReach;
  Box box{{from[0] - kReach, 0}, {to[0] + kReach, 0}};
  if (Dim == 3) {
    box.first[1] = from[1] - kReach;
    box.last[1] = to[1] + kReach;
  }
  return box;
}

// All nodes that the tile's points of each sort reach.
template <int Dim>
std::vector<std::pair<int, Node>> nodes_of(const Tile& tile, const Particles<Dim>& body, const Step<Dim>& step) {
  std::vector<std::pair<int, Node>> nodes;
  constexpr int kReach = Extents::kReach, kAcross = Dim == 3 ? kReach : 0;
  each_point<Dim>(tile, body, step, [&](int which, const Vec<Dim>& x) {
    const auto [from, to] = nearest_nodes<Dim>(x, step);
    for (int j = from[1] - kAcross; j <= to[1] + kAcross; ++j) {
      for (int i = from[0] - kReach; i <= to[0] + kReach; ++i) {
        for (int row = from[2] - kReach; row <= to[2] + kReach; ++row) nodes.push_back({which, {i, j, row}});
      }
    }
  });
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

template <int Dim>
void check_apart(const Tile& a, const Tile& b, const Particles<Dim>& body, const Step<Dim>& step,
                 const EngineState& state) {
  const auto of_a = nodes_of(a, body, step), of_b = nodes_of(b, body, step);
  std::vector<std::pair<int, Node>> shared;
  std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(shared));
  if (shared.empty()) return;
  const Node& node = shared.front().second;
  Vec<Dim> at;
  for (int axis = 0; axis < Dim; ++axis)
    at[axis] = step.origin[axis] + node[axis == Dim - 1 ? 2 : axis] * step.cell[axis];
  throw RunError(
      fmt::format("{}: two parts of {} that are worked on at the same time meet at ({}); it is folded onto "
                  "itself",
                  moment(state), body.name, text<Dim>(at)));
}

}  // namespace

template <int Dim>
void check_colouring(const TilePlan& plan, const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step,
                     const EngineState& state) {
  std::vector<Box> boxes;
  for (const Tile& tile : plan.tiles) boxes.push_back(box_of(tile, bodies[tile.body], step));
  for (std::size_t colour = 0; colour + 1 < plan.colour_begin.size(); ++colour) {
    const int end = plan.colour_begin[colour + 1];
    for (int a = plan.colour_begin[colour]; a < end; ++a) {  // tiles of a body follow each other
      for (int b = a + 1; b < end && plan.tiles[b].body == plan.tiles[a].body; ++b) {
        if (boxes[a].meets(boxes[b]))
          check_apart(plan.tiles[a], plan.tiles[b], bodies[plan.tiles[a].body], step, state);
      }
    }
  }
}

template void check_colouring(const TilePlan&, const std::vector<Particles<2>>&, const Step<2>&, const EngineState&);
template void check_colouring(const TilePlan&, const std::vector<Particles<3>>&, const Step<3>&, const EngineState&);

}  // namespace strandlab::mpm
