// Plane-strain elements of the virtual tests.
#pragma once

#include <array>

#include "strandlab/core/types.hpp"

namespace strandlab::statics {

using PlaneStiffness = Eigen::Matrix<double, 3, 3>;  // MPa: (s11, s22, s12) from (e11, e22, gamma12)
using ElementStiffness =
    Eigen::Matrix<double, 8, 8>;  // N/mm per mm of depth: dofs u_x, u_y of the four corners in turn

// Plane-strain stiffness of a strand in panel axes: the block (11, 33, 13) of its stiffness, with strand axis 1 along
// the unit vector `grain` and axis 3 perpendicular to it in the section.
PlaneStiffness in_section(const VoigtMatrix& strand_stiffness, const Vec<2>& grain);

// Area of a quadrilateral, corners counter-clockwise, mm^2.
double area(const std::array<Vec<2>, 4>& corners);

// Stiffness of the four-node element with incompatible bending modes, condensed (QM6: Taylor, Beresford & Wilson, Int.
// J. Num. Meth. Eng. 10 (1976) 1211). Corners counter-clockwise; 2 x 2 Gauss points. Throws RunError when the element
// is inverted.
ElementStiffness incompatible_quadrilateral(const std::array<Vec<2>, 4>& corners, const PlaneStiffness& stiffness);

}  // namespace strandlab::statics
