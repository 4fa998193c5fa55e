// Vectors and tensors used at interfaces, and the internal units.
#pragma once

#include <Eigen/Core>

// Internal units: mm, s, N, MPa, tonne; hence energy is N mm = mJ and density t/mm^3 = 1e12 kg/m^3.
namespace strandlab {

template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;
template <int Dim>
using Tensor = Eigen::Matrix<double, Dim, Dim>;

// Stress or strain in a strand's own axes 1 = along the strand, 2 = across, 3 = through the thickness, in Voigt order
// (11, 22, 33, 23, 13, 12). For a strand at angle 0 these axes are L, T, R of the wood. Shear strains are engineering.
using Voigt = Eigen::Matrix<double, 6, 1>;
using VoigtMatrix = Eigen::Matrix<double, 6, 6>;

inline constexpr double kTonnePerMm3 = 1e-12;  // 1 kg/m^3 in t/mm^3

}  // namespace strandlab
