// Panels for ParaView: one .vtu file per state, and a .pvd collection of the states of a run.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "strandlab/panel/panel.hpp"

namespace strandlab::io {

// What a file says of its panel beyond the panel itself.
template <int Dim>
struct VtuNotes {
  const Panel<Dim>* formed = nullptr;                   // the same strands as formed; none: no displacements
  std::map<std::string, std::string> material_of_kind;  // of kinds that are not in it the material is ""
};

// Unstructured grid, one cell per material point (a quadrilateral of the strand's corner lattice, in 3D a hexahedron).
// Points are in mm; a section lies in the plane z = 0. Point data: displacement_mm, since the panel was formed. Cell
// data:
//   density_kg_m3, grain_angle_deg (against the panel's plane, local), stress_MPa (Cauchy, tension positive, panel axes
//   XX YY ZZ XY YZ XZ; in a section Z is across, out of the picture), the fields of points that are shown as they are
//   (lattice/points.hpp), velocity_m_s, strand_id (order in the panel), row (0 at the bottom), kind (order in the field
//   data), laid_angle_deg (of the strand's grain in the panel's plane).
// Field data: kinds and materials by their names, in the order of `kind`; TimeValue and compaction, thickness_mm,
// time_ms; units, a sentence.
// Replaces `file` atomically, throws as files::write_atomically(). Dim is 2 or 3.
template <int Dim>
void write_annotated_vtu(const Panel<Dim>& panel, const VtuNotes<Dim>& notes, const std::filesystem::path& file);
// The same without displacements and names of materials.
template <int Dim>
void write_vtu(const Panel<Dim>& panel, const std::filesystem::path& file);

// A point of a glue line between two strands of a section. It goes on from the one before it where the strands are the
// same and it is as near as that line's points are.
struct GlueLinePoint {
  int strand_a = 0, strand_b = 0;
  Vec<2> position;                // mm
  double slip_mm_per_strain = 0;  // of b along a, per unit of mean strain; nan: not known
};
// Glue lines as segments between their points: point data slip_mm_per_strain, cell data strand_a and strand_b.
void write_glue_vtu(const std::vector<GlueLinePoint>& points, const std::filesystem::path& file);

struct PvdEntry {
  double compaction = 0;  // taken as ParaView's time
  std::string file;       // relative to the .pvd file
};
void write_pvd(const std::vector<PvdEntry>& entries, const std::filesystem::path& file);

}  // namespace strandlab::io
