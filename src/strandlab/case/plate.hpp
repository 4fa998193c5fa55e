// Cases whose mats are plates: of mat.width_mm, or with a mat file in three dimensions.
#pragma once

#include "strandlab/case/case.hpp"
#include "strandlab/mat/plate.hpp"
#include "strandlab/vtest/plate.hpp"

namespace strandlab::cases {

// Whether the case's mat is a plate's: one that is formed by the keys of plates, or a mat file in 3D, which a section's
// keys may stand beside. Throws InputError for a file that is no mat file.
bool has_plate_mat(const Case& c);

// The mat of such a case, from its file or formed. Throws InputError as make_plate() (plate_mat.hpp), and for a hot
// press.
mat::PlateMat make_plate_mat(const Case& c);
Weight weigh(const Case& c, const mat::PlateMat& mat);
double density_kg_m3(const Case& c, const mat::PlateMat& mat, double compaction);
// As for sections (case.hpp).
void settle_states(Case& c, const mat::PlateMat& mat);
// Whether the mat of a case whose states are settled is pressed at all, or only tested as it lies.
bool is_pressed(const Case& c);
// The panel of a case whose states are settled, before pressing, with the material points of the case's grid; of one
// that is only tested as it lies as coarse as the elements of its tests. Throws InputError as make_panel() of the room
// panel.
Panel<3> make_panel(const Case& c, const mat::PlateMat& mat);
// The sides of its pressing: as the mat has them, those of a cut mat as the case says.
mpm::Side press_sides(const Case& c, const mat::PlateMat& mat);

// What a pressing will take.
struct PlatePressSize {
  std::size_t particles = 0;
  double steps = 0;
  double memory_bytes = 0, disk_bytes = 0;
  double press_s = 0;  // wall time
};
PlatePressSize press_size(const Case& c, const Panel<3>& panel);

// Of the case's tests what holds for plates: glue, curing, elements. Which tests are made follows from the mat's sides.
vtest::PlateOptions plate_options(const Case& c);

}  // namespace strandlab::cases
