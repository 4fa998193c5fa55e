// Pictures of the layers of a plate's mat, from above.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "strandlab/mat/plate.hpp"

namespace strandlab::report {

// An SVG of one layer, y upwards, axes in mm: its strands, and their images where the window repeats, as far as they
// lie in the window, in the order of laying; coloured by their angle from that of their kind, to kWidestAngle_deg
// either way.
inline constexpr double kWidestAngle_deg = 60;
std::string layer_picture(const mat::PlateMat& mat, std::size_t layer, const std::vector<mat::RoleAngle>& roles);

}  // namespace strandlab::report
