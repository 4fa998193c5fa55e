#include "strandlab/statics/element.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

#include "strandlab/core/error.hpp"

namespace strandlab::statics {
namespace {

using Gradients = Eigen::Matrix<double, 2, 4>;  // of the four shape functions

// Derivatives with respect to the natural coordinates (r, s) of N = (1 + r_i r)(1 + s_i s)/4.
Gradients natural_gradients(double r, double s) {
  Gradients d;
  d << -(1 - s), 1 - s, 1 + s, -(1 + s),  //
      -(1 - r), -(1 + r), 1 + r, 1 - r;
  return 0.25 * d;
}

// Columns of the strain matrix that belong to a function with the given gradient.
Eigen::Matrix<double, 3, 2> strain_columns(const Vec<2>& gradient) {
  Eigen::Matrix<double, 3, 2> b;
  b << gradient[0], 0, 0, gradient[1], gradient[1], gradient[0];
  return b;
}

}  // namespace

PlaneStiffness in_section(const VoigtMatrix& strand_stiffness, const Vec<2>& grain) {
  constexpr std::array<int, 3> kept{0, 2, 4};  // 11, 33, 13
  PlaneStiffness local;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) local(i, j) = strand_stiffness(kept[i], kept[j]);
  }
  // Engineering strains in strand axes from those in panel axes.
  const double c = grain[0], s = grain[1];
  PlaneStiffness t;
  t << c * c, s * s, c * s,  //
      s * s, c * c, -c * s,  //
      -2 * c * s, 2 * c * s, c * c - s * s;
  return t.transpose() * local * t;
}

double area(const std::array<Vec<2>, 4>& x) {
  const Vec<2> p = x[2] - x[0], q = x[3] - x[1];
  return 0.5 * (p[0] * q[1] - p[1] * q[0]);
}

ElementStiffness incompatible_quadrilateral(const std::array<Vec<2>, 4>& corners, const PlaneStiffness& stiffness) {
  Eigen::Matrix<double, 4, 2> x;
  for (int i = 0; i < 4; ++i) x.row(i) = corners[i];
  const Tensor<2> j0 = natural_gradients(0, 0) * x;
  const double det0 = j0.determinant();
  const Tensor<2> inverse0 = j0.inverse();

  Eigen::Matrix<double, 12, 12> full = Eigen::Matrix<double, 12, 12>::Zero();  // 8 corner dofs, 4 of the two modes
  const double g = 1 / std::sqrt(3.0);
  for (const double s : {-g, g}) {
    for (const double r : {-g, g}) {
      const Gradients natural = natural_gradients(r, s);
      const Tensor<2> jacobian = natural * x;
      const double det = jacobian.determinant();
      if (!(det > 0)) {
        throw RunError(
            fmt::format("inverted element at x = {:.3f} mm, y = {:.3f} mm", x.col(0).mean(), x.col(1).mean()));
      }
      const Gradients gradient = jacobian.inverse() * natural;
      Eigen::Matrix<double, 3, 12> b;
      for (int i = 0; i < 4; ++i) b.middleCols<2>(2 * i) = strain_columns(gradient.col(i));
      // Modes 1 - r^2 and 1 - s^2 with the Jacobian of the centre, so that they do no work on a constant stress.
      b.middleCols<2>(8) = strain_columns(det0 / det * inverse0 * Vec<2>(-2 * r, 0));
      b.middleCols<2>(10) = strain_columns(det0 / det * inverse0 * Vec<2>(0, -2 * s));
      full.noalias() += det * b.transpose() * (stiffness * b);
    }
  }
  const Eigen::Matrix<double, 4, 8> coupling = full.bottomLeftCorner<4, 8>();
  const Eigen::Matrix<double, 4, 4> modes = full.bottomRightCorner<4, 4>();
  return full.topLeftCorner<8, 8>() - coupling.transpose() * (modes.inverse() * coupling);
}

}  // namespace strandlab::statics
