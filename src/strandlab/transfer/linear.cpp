#include "strandlab/transfer/linear.hpp"

#include <Eigen/LU>
#include <Eigen/SparseLU>

namespace strandlab::transfer {
namespace {

using Column = Eigen::Vector3d;

// Face i lies between cells i and i + 1.
Eigen::VectorXd solve_column(const BlockSystem& system) {
  const auto n = system.diagonal.size();
  std::vector<Eigen::PartialPivLU<Block>> pivots;
  pivots.reserve(n);
  std::vector<Column> right(n);
  for (std::size_t i = 0; i < n; ++i) {
    Block pivot = system.diagonal[i];
    right[i] = system.right.segment<3>(3 * static_cast<Eigen::Index>(i));
    if (i > 0) {
      pivot -= system.b_by_a[i - 1] * pivots[i - 1].solve(system.a_by_b[i - 1]);
      right[i] -= system.b_by_a[i - 1] * pivots[i - 1].solve(right[i - 1]);
    }
    pivots.emplace_back(pivot);
  }
  Eigen::VectorXd x(system.right.size());
  for (std::size_t i = n; i-- > 0;) {
    if (i + 1 < n) right[i] -= system.a_by_b[i] * x.segment<3>(3 * static_cast<Eigen::Index>(i + 1));
    x.segment<3>(3 * static_cast<Eigen::Index>(i)) = pivots[i].solve(right[i]);
  }
  return x;
}

Eigen::VectorXd solve_sparse(const std::vector<Face>& faces, const BlockSystem& system) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int row, int column, const Block& block) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) entries.emplace_back(3 * row + i, 3 * column + j, block(i, j));
    }
  };
  for (std::size_t i = 0; i < system.diagonal.size(); ++i)
    add(static_cast<int>(i), static_cast<int>(i), system.diagonal[i]);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    add(faces[i].a, faces[i].b, system.a_by_b[i]);
    add(faces[i].b, faces[i].a, system.b_by_a[i]);
  }
  Eigen::SparseMatrix<double> matrix(system.right.size(), system.right.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> lu(matrix);
  if (lu.info() != Eigen::Success) return {};
  return lu.solve(system.right);
}

}  // namespace

Eigen::VectorXd solve(const Grid& grid, const std::vector<Face>& faces, const BlockSystem& system) {
  auto x = grid.columns == 1 ? solve_column(system) : solve_sparse(faces, system);
  return x.allFinite() ? x : Eigen::VectorXd();
}

}  // namespace strandlab::transfer
