// What the material points of a strand show to the outside: density, grain angle, Cauchy stress in panel axes. For
// files and pictures.
#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "strandlab/panel/panel.hpp"

namespace strandlab {

// Density now, kg/m^3: that at formation over det F (a section is in plane strain).
template <int Dim>
double density_kg_m3(const Strand<Dim>& strand, std::size_t point) {
  return strand.material.density / kTonnePerMm3 / strand.points.F[point].determinant();
}

// Angle of the strand's long axis F a0 against the panel's plane, degrees, positive when it climbs along x; -90..90.
template <int Dim>
double grain_angle_deg(const Tensor<Dim>& F) {
  return std::asin(std::clamp(grain<Dim>(F)[Dim - 1], -1.0, 1.0)) * 180 / std::numbers::pi;
}

// Thickness of the strand at a point, perpendicular to its long axis, over that at formation, minus 1: a slab keeps its
// volume J V0 = thickness x length (x width), so t/t0 = det F / |F a0| and in 3D det F / |F a0 x F b0|.
template <int Dim>
double thickness_strain(const Tensor<Dim>& F) {
  if constexpr (Dim == 2) {
    return F.determinant() / F.col(0).norm() - 1;
  } else {
    return F.determinant() / F.col(0).cross(F.col(1)).norm() - 1;
  }
}

// Strand axes as columns 1 along (F a0), 2 across, 3 through the thickness, in the axes (x, y, z): of a section x is
// along, y through the thickness and z out of the picture, so that 2 = 3 x 1 = -z.
template <int Dim>
Tensor<3> strand_axes(const Tensor<Dim>& F) {
  Tensor<3> axes;
  if constexpr (Dim == 2) {
    const Vec<2> a = grain<2>(F);
    axes << a[0], 0, -a[1],  //
        a[1], 0, a[0],       //
        0, -1, 0;
  } else {
    axes.col(0) = grain<3>(F);
    axes.col(2) = axes.col(0).cross(F.col(1)).normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
  }
  return axes;
}

// Cauchy stress tau/J of a point, MPa, tension positive, in the axes (x, y, z) of strand_axes().
template <int Dim>
Tensor<3> cauchy_stress(const Tensor<Dim>& F, const Voigt& kirchhoff) {
  Tensor<3> tau;
  tau << kirchhoff[0], kirchhoff[5], kirchhoff[4],  //
      kirchhoff[5], kirchhoff[1], kirchhoff[3],     //
      kirchhoff[4], kirchhoff[3], kirchhoff[2];
  const Tensor<3> axes = strand_axes<Dim>(F);
  return axes * tau * axes.transpose() / F.determinant();
}

}  // namespace strandlab
