// A strand as material points on a lattice, and a panel as its strands: what flows from pressing to curing, virtual
// tests, profiles and pictures.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "strandlab/core/types.hpp"
#include "strandlab/lattice/points.hpp"
#include "strandlab/mat/mat.hpp"
#include "strandlab/mat/plate.hpp"
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

// One strand: its wood, its lattice, and the state of the material points on it.
template <int Dim>
struct Strand {
  std::string kind;  // name of its StrandKind
  int row = 0;       // layer of the mat, 0 at the bottom
  double angle_deg = 0;
  wood::StrandMaterial material;  // elastic as tested, cold; yielding as in the press
  double stiffness_factor = 1;    // elastic stiffness in the press over that of the material
  Lattice<Dim> lattice;           // as formed
  Points<Dim> points;
  std::size_t size() const { return points.size(); }
};

// State of a panel at one compaction.
template <int Dim>
struct Panel {
  double length_mm = 0;              // along x, window 0..length
  double depth_mm = 1;               // across: 1 for a section, in 3D the window's width along y
  bool periodic = false;             // 3D: the window is a torus, on which strands meet the images of others
  double initial_thickness_mm = 0;   // platen gap of the mat as formed
  double bottom_mm = 0, top_mm = 0;  // platen faces now; thickness = top - bottom
  double time_s = 0;
  std::vector<Strand<Dim>> strands;  // by row, then by x
  double thickness_mm() const { return top_mm - bottom_mm; }
  double compaction() const { return 1 - thickness_mm() / initial_thickness_mm; }
};

// Points as the panel's strands have them: which optional fields there are (lattice/points.hpp).
template <int Dim>
const Points<Dim>& pattern_of_points(const Panel<Dim>& panel) {
  static const Points<Dim> none;
  return panel.strands.empty() ? none : panel.strands.front().points;
}

// The kind that a layer's role names, and the wood of one of its strands: the strand's own where the mat names one,
// else its kind's. `layer` counts from 0, for messages. Throw InputError for an unknown role or material, with the
// nearest known one.
const StrandKind& find_kind(const std::vector<StrandKind>& kinds, const std::string& role, std::size_t layer);
const wood::Material& find_material(const StrandKind& kind, const mat::Strand& strand,
                                    const std::vector<StrandKind>& kinds, std::size_t layer);
const wood::Material& find_material(const StrandKind& kind, const mat::PlateStrand& strand,
                                    const std::vector<StrandKind>& kinds, std::size_t layer, std::size_t number);

// A strand as formed, without a place in a mat or a kind: at rest, unstressed, its history of yielding that of its
// wood.
template <int Dim>
Strand<Dim> formed_strand(const Lattice<Dim>& lattice, const Placement<Dim>& placement,
                          const wood::StrandMaterial& material) {
  Strand<Dim> strand;
  strand.material = material;
  strand.lattice = lattice;
  strand.points = formed_points(lattice, placement);
  strand.points.plastic.assign(lattice.size(), material.start());
  return strand;
}

// The panel of a mat before pressing: every strand becomes a lattice with a spacing along it close to
// `spacing_along_mm` that fills its length exactly. Strands of the thinnest row have `points_through` points through
// their thickness, others as many as keep the points' height nearest to that. Throws as find_kind() and
// find_material(). A strand that names a material of its own still yields by the law of its kind.
Panel<2> make_panel(const mat::Mat& mat, const std::vector<StrandKind>& kinds, double spacing_along_mm,
                    int points_through);

// The same of a plate's mat in layers: every strand is a whole lattice in its own axes, points about `spacing_mm` apart
// along and across, turned about its middle. Where the window is periodic positions go on beyond its edges. Throws
// InputError for a draped mat too.
Panel<3> make_panel(const mat::PlateMat& mat, const std::vector<StrandKind>& kinds, double spacing_mm,
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
// Exact for the mat as it lies: sums of length x thickness (x width) x density over its strands. Throws as
// make_panel().
Weight weigh(const mat::Mat& mat, const std::vector<StrandKind>& kinds);
Weight weigh(const mat::PlateMat& mat, const std::vector<StrandKind>& kinds);

// Thickness (mm, as formed) of the panel's thinnest strand. The panel must have one.
template <int Dim>
double thinnest_strand(const Panel<Dim>& panel) {
  double thinnest = panel.strands.front().lattice.thickness();
  for (const auto& strand : panel.strands) thinnest = std::min(thinnest, strand.lattice.thickness());
  return thinnest;
}

// Positions of a strand's corners, mm.
template <int Dim>
std::vector<Vec<Dim>> corners(const Strand<Dim>& strand) {
  return corners(strand.lattice, strand.points);
}

// Unit grain direction of a point: F a0 / |F a0|.
template <int Dim>
Vec<Dim> grain(const Tensor<Dim>& F) {
  return F.col(0).normalized();
}

}  // namespace strandlab
