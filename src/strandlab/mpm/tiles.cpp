#include "strandlab/mpm/tiles.hpp"

#include <algorithm>

namespace strandlab::mpm {
namespace {

constexpr int kTileColumns = 32;   // particles of a tile along the strand (2D)
constexpr int kTileColumns3 = 16;  // and along and across it (3D)

void add_run(std::vector<std::vector<int>>& blocks, const std::vector<int>& run) {
  for (std::size_t i = 0; i < run.size(); i += kBlock) {
    blocks.emplace_back(run.begin() + static_cast<long>(i),
                        run.begin() + static_cast<long>(std::min(run.size(), i + kBlock)));
  }
}

}  // namespace

template <int Dim>
std::vector<TileParticles> split_into_tiles(const Body<Dim>& body) {
  std::vector<TileParticles> tiles;
  const auto& lattice = body.lattice;
  if (lattice.size() != body.points.size()) {
    std::vector<int> all(body.points.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    tiles.emplace_back();
    add_run(tiles.back().blocks, all);
    return tiles;
  }
  const int width = Dim == 2 ? kTileColumns : kTileColumns3;
  const int nx = lattice.counts[0], ny = lattice.counts[1], nz = Dim == 3 ? lattice.counts[Dim - 1] : 1;
  const int across = Dim == 3 ? width : ny;  // in 2D a tile holds all rows
  for (int j0 = 0; j0 < ny; j0 += across) {
    for (int i0 = 0; i0 < nx; i0 += width) {
      tiles.emplace_back();
      tiles.back().colour = (i0 / width) % 2 + (Dim == 3 ? 2 * ((j0 / width) % 2) : 0);
      for (int k = 0; k < nz; ++k) {
        for (int j = j0; j < std::min(ny, j0 + across); ++j) {
          std::vector<int> run;
          for (int i = i0; i < std::min(nx, i0 + width); ++i) {
            typename Lattice<Dim>::Place place{i, j};
            if (Dim == 3) place[Dim - 1] = k;
            run.push_back(static_cast<int>(lattice.point(place)));
          }
          add_run(tiles.back().blocks, run);
        }
      }
    }
  }
  return tiles;
}

TilePlan sort_by_colour(const std::vector<ColouredTile>& tiles) {
  std::vector<int> order(tiles.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return tiles[a].colour < tiles[b].colour; });
  TilePlan plan;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || tiles[order[i]].colour != tiles[order[i - 1]].colour)
      plan.colour_begin.push_back(static_cast<int>(i));
    plan.tiles.push_back(tiles[order[i]].tile);
  }
  plan.colour_begin.push_back(static_cast<int>(tiles.size()));
  return plan;
}

template std::vector<TileParticles> split_into_tiles<2>(const Body<2>&);
template std::vector<TileParticles> split_into_tiles<3>(const Body<3>&);

}  // namespace strandlab::mpm
