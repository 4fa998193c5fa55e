#include "strandlab/core/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

namespace strandlab {

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace strandlab
