#include "strandlab/mpm/time_step.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace strandlab::mpm {
namespace {

// Columns: along, across, thickness; rows: x, y, z.
template <int Dim>
Eigen::Matrix3d strand_axes(const Tensor<Dim>& F) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if constexpr (Dim == 2) {
    const Vec<2> g = grain<2>(F);
    axes.col(0) << g[0], 0, g[1];
    axes.col(2) << -g[1], 0, g[0];
  } else {
    const Eigen::Vector3d along = F.col(0).normalized();
    const Eigen::Vector3d t = along.cross(Eigen::Vector3d(F.col(1))).normalized();
    axes << along, t.cross(along), t;
  }
  return axes;
}

// Largest row sum of the acoustic tensor of direction n, MPa: bounds its eigenvalues.
double acoustic_stiffness(const VoigtMatrix& c, const Eigen::Vector3d& n) {
  Eigen::Matrix<double, 6, 3> B;
  B << n[0], 0, 0, 0, n[1], 0, 0, 0, n[2], 0, n[2], n[1], n[2], 0, n[0], n[1], n[0], 0;
  const Eigen::Matrix3d acoustic = B.transpose() * c * B;
  return acoustic.cwiseAbs().rowwise().sum().maxCoeff();
}

}  // namespace

template <int Dim>
StepLimit<Dim> step_limit(const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step) {
  using C = Component<Dim>;
  StepLimit<Dim> limit;
  for (const auto& body : bodies) {
    const int every = body.blocks > 32 ? 4 : 1;  // the grain angle varies slowly along a strand
    for (int b = 0; b < body.blocks; b += every) {
      const double* d = body.block(b);
      const Eigen::Matrix3d axes = strand_axes<Dim>(body.deformation(d));
      for (int a = 0; a < Dim; ++a) {
        const double stiffness =
            body.stiffest * acoustic_stiffness(body.material.stiffness, axes.row(Dim == 2 ? 2 * a : a));
        double pressure = 0;
        for (int k = 0; k < body.components; ++k) pressure = std::max(pressure, std::abs(d[(C::stress + k) * kBlock]));
        const double speed =
            std::sqrt((stiffness + pressure) / body.material.density) + std::abs(d[(C::v + a) * kBlock]);
        if (step.cell[a] / speed < limit.time_s) limit = {step.cell[a] / speed, &body, d};
      }
    }
  }
  return limit;
}

template StepLimit<2> step_limit(const std::vector<Particles<2>>&, const Step<2>&);
template StepLimit<3> step_limit(const std::vector<Particles<3>>&, const Step<3>&);

}  // namespace strandlab::mpm
