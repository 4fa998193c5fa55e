// The mat of the case of a plate (3D).
#pragma once

#include <vector>

#include "strandlab/case/case.hpp"
#include "strandlab/mat/plate_form.hpp"

namespace strandlab::cases {

// Rows of the layup with the sizes, thickness and angles of their kinds. Throws InputError for a row that names no
// kind.
mat::PlateLayup plate_layup(const Case& c);
// The angles of strands that a mat file gives none.
std::vector<mat::RoleAngle> role_angles(const Case& c);
// Read from the case's mat file, without drawn angles, else formed with its seed. Throws InputError for a bad mat file,
// the case of a section, and as mat::form().
mat::FormedPlate make_plate(const Case& c);

}  // namespace strandlab::cases
