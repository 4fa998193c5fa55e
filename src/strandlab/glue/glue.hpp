// Curing: every face-to-face contact between two strands of a pressed panel becomes a glue line.
#pragma once

#include <vector>

#include "strandlab/panel/panel.hpp"

namespace strandlab::glue {

enum class Side { kBottom, kTop };

// A material point of a strand's top or bottom face: between corners i and i+1 of that face (corner lattice of
// strandlab::corners), at local coordinate xi in [0,1].
template <int Dim>
struct FacePoint {
  int strand = 0;
  Side side = Side::kTop;
  int segment = 0;
  double xi = 0;
  Vec<Dim> position;  // mm
};

// One spring of a glue line between a point of strand a's face and its projection on strand b's face.
// [u_t] = tau/D_t, [u_n] = sigma/D_n with [u] = u_b - u_a.
template <int Dim>
struct GluePoint {
  FacePoint<Dim> a, b;
  Vec<Dim> normal;  // unit, averaged: (n_a - n_b)/|n_a - n_b|, from a to b
  double area = 0;  // mm (2D: deformed length x 1 mm of depth) or mm^2
  double gap = 0;   // mm, signed distance along the normal
};

struct CuringOptions {
  double max_gap_mm = 0.1;      // faces further apart than this do not bond
  double point_spacing_mm = 0;  // along the strand as formed, between glue points; 0: as the material points
};

// Glue points of a pressed panel. A face point is glued to the nearest facing strand, where its projection along its
// face's normal falls on that strand's face within max_gap_mm and nothing of another strand lies between: never through
// a strand, and no face point twice. A stretch of contact ends where a strand ends or where the gap opens;
// its points divide it evenly, both ends included, so that glue lines change continuously with the strands. One
// constraint per point, no more points than face corners, and normals interpolated from the corners' mean normals: a
// perfect bond does not lock. Strand ends do not bond. Deterministic order: by strand (of its top face), then by facing
// strand, then along the face. Throws InputError for a gap that is not positive or a negative spacing.
std::vector<GluePoint<2>> cure(const Panel<2>& panel, const CuringOptions& options);

// Length of strand faces (mm) that could be glued: top faces but those of the top row, bottom faces but those of the
// bottom row. A panel without gaps has a glued length of half of this.
double facing_length(const Panel<2>& panel);

}  // namespace strandlab::glue
