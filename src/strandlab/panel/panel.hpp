// A strand as a lattice of material points, and a panel as its strands: what flows from pressing to curing, virtual
// tests, profiles and pictures.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "strandlab/core/types.hpp"
#include "strandlab/mat/mat.hpp"
#include "strandlab/wood/material.hpp"

namespace strandlab {

// A kind of strand: what a role in a mat file names.
struct StrandKind {
  std::string name;
  wood::Material material;
  double angle_deg = 0;  // grain against the section (0 surface, 90 core)
  // How heat and moisture soften the strand in the press: yield stresses with the hardening modulus K, and elastic
  // moduli, over those of the material. The pressed panel is tested cold, with the material's own moduli.
  double yield_factor = 1, stiffness_factor = 1;
  wood::OffAxis off_axis = wood::OffAxis::kExact;
};

// One strand: points[0] x points[1] (x points[2]) material points, along x [across x] through the thickness (last
// axis). Point (i, j[, k]) has index i + points[0]*(j [+ points[1]*k]): along the strand runs fastest, rows stack
// through the thickness. All arrays have that order and length size().
template <int Dim>
struct Strand {
  std::string kind;  // name of its StrandKind
  int row = 0;       // layer of the mat, 0 at the bottom
  double angle_deg = 0;
  wood::StrandMaterial material;  // elastic as tested, cold; yielding as in the press
  double stiffness_factor = 1;    // elastic stiffness in the press over that of the material
  std::array<int, Dim> points{};
  Vec<Dim> spacing;             // mm, of the points at formation: strand length = points[0]*spacing[0], exactly
  std::vector<Vec<Dim>> x;      // mm, positions now
  std::vector<Vec<Dim>> v;      // mm/s
  std::vector<Tensor<Dim>> F;   // deformation gradient since formation
  std::vector<Voigt> stress;    // MPa, Kirchhoff, strand axes convected with the strand (along = F a0)
  std::vector<double> plastic;  // history of yielding: alpha, accumulated plastic strain, or x where the wood crushes
  std::size_t size() const { return x.size(); }
  double point_volume() const { return spacing.prod(); }  // mm^3 (2D: per mm of depth), at formation
};

// State of a panel at one compaction.
template <int Dim>
struct Panel {
  double length_mm = 0;              // along x, window 0..length
  double depth_mm = 1;               // across; 1 for a section
  double initial_thickness_mm = 0;   // platen gap of the mat as formed
  double bottom_mm = 0, top_mm = 0;  // platen faces now; thickness = top - bottom
  double time_s = 0;
  std::vector<Strand<Dim>> strands;  // by row, then by x
  double thickness_mm() const { return top_mm - bottom_mm; }
  double compaction() const { return 1 - thickness_mm() / initial_thickness_mm; }
};

// The kind that a layer's role names, and the wood of one of its strands: the strand's own where the mat names one,
// else its kind's. `layer` counts from 0, for messages. Throw InputError for an unknown role or material, with the
// nearest known one.
const StrandKind& find_kind(const std::vector<StrandKind>& kinds, const std::string& role, std::size_t layer);
const wood::Material& find_material(const StrandKind& kind, const mat::Strand& strand,
                                    const std::vector<StrandKind>& kinds, std::size_t layer);

// The panel of a mat before pressing: every strand becomes a lattice with a spacing along it close to
// `spacing_along_mm` that fills its length exactly. Strands of the thinnest row have `points_through` points through
// their thickness, others as many as keep the points' height nearest to that. Throws as find_kind() and
// find_material(). A strand that names a material of its own still yields by the law of its kind.
Panel<2> make_panel(const mat::Mat& mat, const std::vector<StrandKind>& kinds, double spacing_along_mm,
                    int points_through);

// Parts of a mat's weight.
struct WeightShare {
  std::string name;
  double fraction = 0;
};
struct Weight {
  double kg_per_m2 = 0;                           // of panel area
  std::vector<WeightShare> by_kind, by_material;  // from the bottom up; each sums to 1
};
// Exact for the mat as it lies: sums of length x thickness x density over its strands. Throws as make_panel().
Weight weigh(const mat::Mat& mat, const std::vector<StrandKind>& kinds);

// Thickness (mm, as formed) of a strand, and of the panel's thinnest one. The panel must have a strand.
template <int Dim>
double formed_thickness(const Strand<Dim>& strand) {
  return strand.points[Dim - 1] * strand.spacing[Dim - 1];
}
template <int Dim>
double thinnest_strand(const Panel<Dim>& panel) {
  double thinnest = formed_thickness(panel.strands.front());
  for (const auto& strand : panel.strands) thinnest = std::min(thinnest, formed_thickness(strand));
  return thinnest;
}

// A strand's outline and elements come from its corner lattice: (points[0]+1) x (points[1]+1) corners, along fastest,
// each the mean of the corners that the adjacent particle domains (parallelograms x +- F spacing/2) put there.
std::vector<Vec<2>> corners(const Strand<2>& strand);

// Unit grain direction of a point: F a0 / |F a0|.
template <int Dim>
Vec<Dim> grain(const Tensor<Dim>& F) {
  return F.col(0).normalized();
}

}  // namespace strandlab
