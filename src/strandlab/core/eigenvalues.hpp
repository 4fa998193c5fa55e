// Eigenvalues, compiled once: the solver is long to compile, most of all for large matrices of fixed size.
#pragma once

#include <Eigen/Core>

namespace strandlab {

// Of a symmetric matrix, of which the lower triangle is read, in ascending order.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);

}  // namespace strandlab
