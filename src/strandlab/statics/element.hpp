// Elements of the virtual tests: plane-strain quadrilaterals of a section, bricks of a panel.
#pragma once

#include <array>

#include "strandlab/core/types.hpp"

namespace strandlab::statics {

template <int Dim>
inline constexpr int kCorners = 1 << Dim;  // of an element
template <int Dim>
inline constexpr int kStrains = Dim*(Dim + 1) / 2;

// Stiffness of the wood in panel axes, MPa, for engineering strains: in a section (11, 22, 12), in a panel in Voigt
// order.
template <int Dim>
using WoodStiffness = Eigen::Matrix<double, kStrains<Dim>, kStrains<Dim>>;
using PlaneStiffness = WoodStiffness<2>;

// Dofs of an element's corners in turn: u_x, u_y [, u_z] of each.
template <int Dim>
inline constexpr int kElementDofs = Dim* kCorners<Dim>;
template <int Dim>
using ElementDofs = Eigen::Matrix<double, kElementDofs<Dim>, 1>;
// N/mm (2D: per mm of depth).
template <int Dim>
using ElementStiffness = Eigen::Matrix<double, kElementDofs<Dim>, kElementDofs<Dim>>;

// Corners of an element: counter-clockwise, in 3D those of its lower face, then those above them (Lattice::cell()).
template <int Dim>
using ElementCorners = std::array<Vec<Dim>, kCorners<Dim>>;

// Plane-strain stiffness of a strand in panel axes: the block (11, 33, 13) of its stiffness, with strand axis 1 along
// the unit vector `grain` and axis 3 perpendicular to it in the section.
PlaneStiffness in_section(const VoigtMatrix& strand_stiffness, const Vec<2>& grain);

// Stiffness of a strand in panel axes; the columns of `axes` are the strand's axes along, across and through its
// thickness, orthonormal.
VoigtMatrix in_panel(const VoigtMatrix& strand_stiffness, const Tensor<3>& axes);

// Area of a quadrilateral, mm^2; volume of a brick by the element's own quadrature, mm^3.
double area(const ElementCorners<2>& corners);
double volume(const ElementCorners<3>& corners);

// Stiffness of the element with incompatible bending modes, condensed: 1 - r^2 for each natural coordinate r and each
// displacement, with the Jacobian of the centre (2D: QM6; Wilson et al. with the correction of Taylor, Beresford &
// Wilson, Int. J. Num. Meth. Eng. 10 (1976) 1211; 3D: the same with nine modes). Two Gauss points an axis. Throws
// RunError when the element is inverted.
template <int Dim>
ElementStiffness<Dim> incompatible_element(const ElementCorners<Dim>& corners, const WoodStiffness<Dim>& stiffness);

// Strains of a plate: e_xx, e_yy, g_xy at the height `middle`, then k_xx, k_yy, k_xy with k_ab = -w,ab and k_xy = -2
// w,xy. At a height z the strain is e + (z - middle) k in its plane and nothing else.
using PlateStrain = Eigen::Matrix<double, 6, 1>;
using PlateStiffness = Eigen::Matrix<double, 6, 6>;

// What an element of a panel answers to plate strains beside its corners' displacements u, energy
//   1/2 u.K u + u.loads p + 1/2 p.own p
// with its incompatible modes condensed.
struct PlateTerms {
  Eigen::Matrix<double, kElementDofs<3>, 6> loads;  // N, and N mm for curvatures
  PlateStiffness own;                               // N mm and further mm for curvatures
};
PlateTerms plate_terms(const ElementCorners<3>& corners, const VoigtMatrix& stiffness, double middle);

}  // namespace strandlab::statics
