// Panels for ParaView: one .vtu file per state, and a .pvd collection of the states of a run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "strandlab/panel/panel.hpp"

namespace strandlab::io {

// Unstructured grid, one cell per material point (a quadrilateral of the strand's corner lattice, in 3D a hexahedron).
// Points are in mm; a section lies in the plane z = 0. Cell data:
//   density_kg_m3, grain_angle_deg (against the panel's plane), stress_MPa (Cauchy, tension positive, panel axes XX YY
//   ZZ XY YZ XZ; in a section Z is across, out of the picture), the fields of points that are shown as they are
//   (lattice/points.hpp), velocity_m_s, strand_id (order in the panel), row (0 at the bottom), angle_deg (of the
//   strand's grain in the panel's plane).
// Replaces `file` atomically, throws as files::write_atomically(). Dim is 2 or 3.
template <int Dim>
void write_vtu(const Panel<Dim>& panel, const std::filesystem::path& file);

struct PvdEntry {
  double compaction = 0;  // taken as ParaView's time
  std::string file;       // relative to the .pvd file
};
void write_pvd(const std::vector<PvdEntry>& entries, const std::filesystem::path& file);

}  // namespace strandlab::io
