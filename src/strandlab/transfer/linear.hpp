// The linear systems of Newton's method: 3x3 blocks, one diagonal block per cell and two per face.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "strandlab/transfer/network.hpp"

namespace strandlab::transfer {

struct BlockSystem {
  std::vector<Block> diagonal;        // by cell
  std::vector<Block> a_by_b, b_by_a;  // by face: rows of cell a by the unknowns of b, and the other way round
  Eigen::VectorXd right;
};

// The solution; block elimination (Thomas) for one column of cells, sparse LU otherwise. Empty where the matrix is
// singular.
Eigen::VectorXd solve(const Grid& grid, const std::vector<Face>& faces, const BlockSystem& system);

}  // namespace strandlab::transfer
