#include "strandlab/wood/yield_modes.hpp"

#include <Eigen/Eigenvalues>

namespace strandlab::wood {

template <int N>
YieldModes<N> yield_modes(const StrandMaterial& material) {
  using Matrix = Eigen::Matrix<double, N, N>;
  Matrix C, P;
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) {
      C(i, j) = material.stiffness(kModeToVoigt[i], kModeToVoigt[j]);
      P(i, j) = material.yield_surface(kModeToVoigt[i], kModeToVoigt[j]);
    }
  }
  // z = U^T C^(-1/2) tau with C^(1/2) P C^(1/2) = U diag(lambda) U^T.
  const Eigen::SelfAdjointEigenSolver<Matrix> elastic(C);
  const Matrix root = elastic.operatorSqrt();
  const Matrix inverse_root = elastic.operatorInverseSqrt();
  const Eigen::SelfAdjointEigenSolver<Matrix> yield(Matrix(root * P * root));
  const Matrix to = yield.eigenvectors().transpose() * inverse_root;
  const Matrix from = root * yield.eigenvectors();

  YieldModes<N> modes{};
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) {
      modes.stiffness[i][j] = C(i, j);
      modes.to_modes[i][j] = to(i, j);
      modes.from_modes[i][j] = from(i, j);
    }
    modes.volume[i] = to(i, 0) + to(i, 1) + to(i, 2);  // eps_e = to^T z
    modes.lambda[i] = yield.eigenvalues()[i] > 1e-12 * yield.eigenvalues()[N - 1] ? yield.eigenvalues()[i] : 0.0;
  }
  with_law(material.law(), [&]<class L>() { part_of<L>(modes.laws) = L::rule(part_of<L>(material.hardening)); });
  return modes;
}

template YieldModes<4> yield_modes<4>(const StrandMaterial&);
template YieldModes<6> yield_modes<6>(const StrandMaterial&);

bool needs_six(const StrandMaterial& material) {
  const double scale = 1e-9 * material.stiffness.diagonal().maxCoeff();
  for (int i : {0, 1, 2, 4}) {
    for (int j : {3, 5}) {
      if (std::abs(material.stiffness(i, j)) > scale) return true;
    }
  }
  return false;
}

}  // namespace strandlab::wood
