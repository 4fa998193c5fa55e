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
  double max_gap_mm = 0.1;
  int points_per_segment = 2;
};

// Glue points of a pressed panel. A face point is glued to the facing strand where its projection falls on that face within
// max_gap_mm. Strand ends do not bond. Deterministic order: by strand, then along the face.
std::vector<GluePoint<2>> cure(const Panel<2>& panel, const CuringOptions& options);

}  // namespace strandlab::glue
