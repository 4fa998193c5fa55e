// Order of a body's particles in memory and in parallel work: tiles of neighbours, blocks of eight within them.
#pragma once

#include <vector>

#include "strandlab/mpm/engine.hpp"
#include "strandlab/mpm/kernels.hpp"

namespace strandlab::mpm {

// A tile's particles, by their number in the body.
struct TileParticles {
  std::vector<std::vector<int>> blocks;  // up to kBlock neighbours along the strand each
  int colour = 0;                        // tiles of a body that have one colour share no node
};

// Tile by tile, within a tile row by row. Particles without a lattice are one tile.
template <int Dim>
std::vector<TileParticles> split_into_tiles(const Body<Dim>& body);

struct ColouredTile {
  Tile tile;
  int colour;
};

// The tiles of all bodies. A body has nodes of its own: tiles of different bodies never share one.
struct TilePlan {
  std::vector<Tile> tiles;        // by colour
  std::vector<int> colour_begin;  // ranges of tiles that may scatter at the same time
};
TilePlan sort_by_colour(const std::vector<ColouredTile>& tiles);

}  // namespace strandlab::mpm
