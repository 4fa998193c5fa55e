// The engine's inner loops, one function per phase. Plain data only: kernels.cpp, which holds what is in kernels/, is
// compiled once per instruction set and must not share inline code with the rest of the program.
#pragma once

#include "strandlab/mpm/phases.hpp"
#include "strandlab/wood/return_map.hpp"

namespace strandlab::mpm {

inline constexpr int kBlock = 8;   // particles per block: one SIMD pack
inline constexpr int kRecord = 8;  // doubles per node record
inline constexpr int kMaxFaces = 6;
inline constexpr int kMaxFields = 24;           // fields meeting at one node
inline constexpr int kContactPasses = 40;       // over the pairs at a node, at most: judgement, see kContactTolerance
inline constexpr double kLargestStress = 1e30;  // MPa; beyond, and not a number: failed

// Particles live in blocks of eight; a block holds one pack per component, in this order.
template <int Dim>
struct Component {
  static constexpr int x = 0, v = Dim, F = 2 * Dim, stress = F + Dim * Dim;
  static constexpr int plastic(int components) { return stress + components; }     // alpha or x, as the law has it
  static constexpr int radius(int components) { return stress + components + 1; }  // of the yield surface there
  static constexpr int count(int components) { return stress + components + 2; }
};

// Node records before the grid update: {m, p, f} at 0, 1, 1 + Dim; after it: {v, dv} at 0, Dim and m at 7.
// Surface records: {N = sum w A n, W = sum w A, S = sum w A x.n} at 0, Dim, Dim + 1.
template <int Dim>
inline constexpr int kSurfaceRecord = Dim == 2 ? 4 : 8;

// Where the grid and the platens are in this step, and how long it is. Node i of an axis is at origin + i*cell.
template <int Dim>
struct Step {
  double origin[Dim];
  double cell[Dim];
  double inverse_cell[Dim];
  double dt;
  double transit;    // s, of the fastest wave through a cell
  int wall[Dim][2];  // node index of a roller plane, or kNoWall
  struct {
    int present;
    double position, velocity;
  } platen[2];  // bottom, top
  struct {
    double exponent, floor, least, per_strain;  // as in wood::Conditioned
  } rate;
};
inline constexpr int kNoWall = 1 << 30;

// A dense patch of nodes, those of one field: rows on each pencil, a line of nodes through the thickness. Node (pencil,
// row) is record base[pencil] + row: every pencil has an offset of its own, so that its rows begin where the body is.
// (A sketch is in docs/architecture.md.)
struct Patch {
  int first[2];  // first pencil along each lateral axis
  int count[2];  // pencils along each lateral axis (2D: count[1] = 1)
  int height;    // most rows on a pencil
  const int* base;
};

template <int Dim>
struct SurfaceView {
  Patch patch;
  const int* where;      // particle of each face point: offset of its x component in the body's blocks
  const double* offset;  // packs: Dim components of 8 face points, then the next 8
  const double* area;
};

template <int Dim>
struct BodyView {
  double* blocks;
  int components;         // stress components stored: 4 or 6
  double mass, volume;    // of a particle
  double half_size[Dim];  // mm, at formation
  double reach[Dim];      // mm, at formation: furthest offset of a face point from its particle
  const wood::YieldModes<4>* modes4;
  const wood::YieldModes<6>* modes6;
  wood::Law law;            // that holds
  const double* condition;  // per block a pack of factors of stiffness, then one of yield; null: wood as measured
  double Y_R;               // MPa
  Patch patch;
  Patch mirror[2];  // nodes of its mirror images in the bottom and top platens; height 0: far away
  int faces;
  SurfaceView<Dim> face[kMaxFaces];
};

// A platen acts on a body as contact with the body's own mirror image: exact for a flat rigid wall wherever it lies
// between the grid lines. Particles within this distance of it, in cells, are mirrored: contact with a platen is
// resolved at nodes up to 1.5 cells from it (kernels/grid_update.hpp), and a particle reaches a node from less than 1.5
// cells away. Of an image further away than this at most a tenth falls on a node that the body itself reaches.
// Judgement.
inline constexpr double kMirrorDepth = 2.3;

// Unit of parallel work: a run of blocks of one body, and the face points that ride on them (in packs of eight).
struct Tile {
  int body;
  int block_begin, block_end;
  int face_begin[kMaxFaces], face_end[kMaxFaces];
};

struct TileResult {
  double plastic;         // mJ dissipated in this step
  double kinetic_change;  // mJ, 1/2 sum m |dv|^2 of the particles
  double stress_change;   // mJ, 1/2 sum V0 dtau : d eps
  double drift[3];        // largest displacement of a particle or a face point per axis, cells
  long long yielding;
  int bad;       // block of the first particle that failed + 1, 0: none
  Phases ticks;  // when timed
};

// A body's nodes on one pencil.
struct PencilField {
  int body;
  int index[2];        // of its nodes; that of the pencil, or whole periods away
  int base;            // record index of row 0
  int row_lo, row_hi;  // rows stored: lo <= row < hi
  int faces;
  struct Rows {
    int base, row_lo, row_hi;
  };
  Rows face[kMaxFaces];
  Rows mirror[2];
};

struct Pencil {
  int index[2];
  int field_begin, field_end;  // in the array of PencilField, by body
  int row_lo, row_hi;          // rows where two fields or a field and a platen may meet
  int slots;                   // first of the row starts
  int ghost;                   // behind a roller plane: folded onto its mirror image
};

// A field whose patch holds a row of a pencil.
struct RowField {
  unsigned short field;  // relative to the pencil's first
  unsigned short faces;  // bit f: the rows of its face f hold this row
};

template <int Dim>
struct GridView {
  double* nodes;
  double* surface;
  const PencilField* fields;
  const int* row_start;  // per pencil row: range in `slots`
  const RowField* slots;
  double friction;            // of bodies on each other
  double platen_friction[2];  // on the bottom and the top platen
};

struct PencilResult {
  double friction, contact;  // mJ
  double platen_impulse[2];  // N s, pressing positive
  double platen_work;        // mJ
  double kinetic_change;     // mJ, 1/2 sum m |dv|^2 on the grid
  double force_change;       // mJ, 1/2 dt sum f.dv on the grid, f without the impulses of contact
  double contact_ticks;
  int overflow;     // nodes where more than kMaxFields fields meet
  int unconverged;  // nodes whose impulses still changed by a hundredth after kContactPasses
  int most_fields;  // that meet at a node
};

template <int Dim>
struct Kernels {
  void (*scatter)(const Tile&, const BodyView<Dim>&, const Step<Dim>&, double* nodes, double* surface,
                  const unsigned char* lanes, bool timed, TileResult&);
  void (*update_grid)(const Pencil&, const Step<Dim>&, const GridView<Dim>&, bool timed, PencilResult&);
  void (*gather)(const Tile&, const BodyView<Dim>&, const Step<Dim>&, const double* nodes, const unsigned char* lanes,
                 bool timed, TileResult&);
  // Radius of the yield surface from the history variable, in the bits of gather.
  void (*set_radius)(const BodyView<Dim>&, int blocks);
};

// The build of the kernels that instruction_set() names (dispatch.hpp). Throws as that.
template <int Dim>
const Kernels<Dim>& kernels();

}  // namespace strandlab::mpm
