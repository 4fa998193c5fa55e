// Cases whose mats are plates: of mat.width_mm, or with a mat file in three dimensions.
#pragma once

#include "strandlab/case/case.hpp"
#include "strandlab/mat/plate.hpp"
#include "strandlab/vtest/plate.hpp"

namespace strandlab::cases {

// Whether the case's mat is a plate's: one that is formed by the keys of plates, or a mat file in 3D, which a section's
// keys may stand beside. Throws InputError for a file that is no mat file.
bool has_plate_mat(const Case& c);

// The mat of such a case, from its file or formed. Throws InputError as make_plate() (plate_mat.hpp), and for states
// other than the mat as it lies.
mat::PlateMat make_plate_mat(const Case& c);
// Its panel, with material points as coarse as the elements of its tests. Throws InputError as make_panel() of the room
// panel.
Panel<3> make_panel(const Case& c, const mat::PlateMat& mat);
Weight weigh(const Case& c, const mat::PlateMat& mat);

// Of the case's tests what holds for plates: glue, curing, elements. Which tests are made follows from the mat's sides.
vtest::PlateOptions plate_options(const Case& c);

}  // namespace strandlab::cases
