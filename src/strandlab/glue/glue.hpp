// Curing: every face-to-face contact between two strands of a pressed panel becomes a glue line.
#pragma once

#include <array>
#include <vector>

#include "strandlab/glue/coverage.hpp"
#include "strandlab/panel/panel.hpp"

namespace strandlab::glue {

enum class StrandFace { kBottom, kTop };

// A material point of a strand's top or bottom face.
template <int Dim>
struct FacePoint;

// In a section: between corners i and i+1 of that face (corner lattice of strandlab::corners), at local coordinate xi
// in [0,1].
template <>
struct FacePoint<2> {
  int strand = 0;
  StrandFace face = StrandFace::kTop;
  int segment = 0;
  double xi = 0;
  Vec<2> position;  // mm
};

// In a panel: at a coordinate of the strand's lattice, along and across. On a periodic window a strand is everywhere a
// period apart; of these images the point is on the one that is shifted by `image` periods along x and y.
template <>
struct FacePoint<3> {
  int strand = 0;
  StrandFace face = StrandFace::kTop;
  Vec<2> place = Vec<2>::Zero();
  std::array<int, 2> image{};
  Vec<3> position = Vec<3>::Zero();  // mm, of the image
};

// One spring of a glue line between a point of strand a's face and its projection on strand b's face.
// [u_t] = tau/D_t, [u_n] = sigma/D_n with [u] = u_b - u_a.
template <int Dim>
struct GluePoint {
  FacePoint<Dim> a, b;
  Vec<Dim> normal;     // unit, averaged: (n_a - n_b)/|n_a - n_b|, from a to b
  double area = 0;     // mm (2D: deformed length x 1 mm of depth) or mm^2
  double gap = 0;      // mm, signed distance along the normal
  double quality = 1;  // of the bond (bond.hpp)
  double lacking = 0;  // mm/MPa, 1/D_t for want of resin (coverage.hpp)
};

struct CuringOptions {
  double max_gap_mm = 0.1;      // faces further apart than this do not bond
  double point_spacing_mm = 0;  // along the strand as formed, between glue points; 0: as the material points
  Coverage coverage;            // with resin
};

// Glue points of a pressed panel. A face point is glued to the nearest facing strand, where its projection along its
// face's normal falls on that strand's face within max_gap_mm and nothing of another strand lies between: never through
// a strand, and no face point twice. A stretch of contact ends where a strand ends or where the gap opens;
// its points divide it evenly, both ends included, so that glue lines change continuously with the strands. One
// constraint per point, no more points than face corners, and normals interpolated from the corners' mean normals: a
// perfect bond does not lock. Strand ends do not bond. Where the points know how far their resin's strength has come
// (Points::bond_quality) a glue point has the mean of its two faces', and is none where that is below kLeastQuality.
// Resin covers the stretch of face that a glue point stands for as it covers the two faces there on average; where it
// covers nothing there is no glue point.
// Deterministic order: by strand (of its top face), then by facing strand, then along the face. Throws InputError for a
// gap that is not positive, a negative spacing or a coverage that cannot be.
std::vector<GluePoint<2>> cure(const Panel<2>& panel, const CuringOptions& options);

// The same of a panel: one glue point for each corner of the lower strand's top face and each strand that faces it
// there, corners `point_spacing_mm` apart as formed. The corner's share of the face (a quarter of each facet around it)
// is cut off where the facing strand ends, where the gap opens and where another strand lies between; what is left is
// the point's area, its middle the point's place. So areas change continuously with the strands, and points away from
// the edges are at corners, where strands of like lattices meet node to node. On a periodic window strands meet the
// images of others and of themselves.
std::vector<GluePoint<3>> cure(const Panel<3>& panel, const CuringOptions& options);

// Length of strand faces (mm) that could be glued: top faces but those of the top row, bottom faces but those of the
// bottom row. A panel without gaps has a glued length of half of this.
double facing_length(const Panel<2>& panel);

}  // namespace strandlab::glue
