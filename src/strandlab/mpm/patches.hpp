// Where each body's nodes are: dense patches of rows on pencils, and for every pencil the fields that live on it.
#pragma once

#include <array>
#include <vector>

#include "strandlab/mpm/kernels.hpp"

namespace strandlab::mpm {

// The rows of nodes that a set of points may touch, on every pencil of their bounding box seen from above.
class Extents {
 public:
  static constexpr int kReach = 1;  // a stencil reaches one node to each side of the nearest

  Extents(std::array<int, 2> first, std::array<int, 2> last);  // of the nodes that may be a point's nearest
  void add(std::array<int, 2> pencil, int row);
  void dilate();                                           // by kReach, laterally and in rows
  void merge(std::array<int, 2> a, std::array<int, 2> b);  // both pencils take the union of their rows

  std::array<int, 2> first, count;
  std::vector<int> lo, hi;  // inclusive; lo > hi: no rows
  int index(std::array<int, 2> pencil) const { return (pencil[1] - first[1]) * count[0] + pencil[0] - first[0]; }
  bool contains(std::array<int, 2> pencil) const {
    return pencil[0] >= first[0] && pencil[0] < first[0] + count[0] && pencil[1] >= first[1] &&
           pencil[1] < first[1] + count[1];
  }

 private:
  bool flat_;
};

// A patch and what it points to. `start`: its first record in the node array.
struct PatchStore {
  Patch patch{};
  std::vector<int> base;
  std::vector<int> lo, hi;  // rows really used, per pencil
  int records = 0;
  void place(const Extents& extents, int start);
  int pencils() const { return patch.count[0] * patch.count[1]; }
};

// All pencils of the grid with their fields, and the rows where fields may meet. On a periodic axis pencils that lie
// whole periods apart are one: there a body also meets the images of others, and its own.
struct PencilTable {
  std::vector<Pencil> pencils;
  std::vector<PencilField> fields;
  std::vector<int> row_start;
  std::vector<RowField> slots;
};

struct BodyPatches {
  PatchStore field;
  std::vector<PatchStore> faces;
  std::array<PatchStore, 2> mirrors;  // images in the bottom and the top platen; no pencils: far away
};

// Of the lateral axes: `walls[axis][side]` is the node index of a roller plane or kNoWall, `periods[axis]` the number
// of cells after which the grid repeats, or 0.
PencilTable tabulate(const std::vector<BodyPatches>& bodies, const std::array<std::array<int, 2>, 2>& walls,
                     const std::array<int, 2>& periods);

}  // namespace strandlab::mpm
