// The linear systems of Newton's method: 3x3 blocks, one diagonal block per cell and two per face.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

#include "strandlab/transfer/network.hpp"

namespace strandlab::transfer {

struct BlockSystem {
  std::vector<Block> diagonal;        // by cell
  std::vector<Block> a_by_b, b_by_a;  // by face: rows of cell a by the unknowns of b, and the other way round
  Eigen::VectorXd right;
};

// Solves such systems by block elimination (Thomas): of the cells of one column; where there are several, of lines of
// cells, all of one height or all of one column, the shorter ones, each coupled to the next cell by cell; its
// blocks are dense, so this is quicker than a sparse LU. Keeps its memory from one solution to the next.
class Elimination {
 public:
  explicit Elimination(const Grid& grid);
  // Empty where the matrix is singular.
  Eigen::VectorXd solve(const std::vector<Face>& faces, const BlockSystem& system);

 private:
  struct Line {
    Eigen::MatrixXd own;
    Eigen::VectorXd right;
    // By cell of the line: its rows by the unknowns of the next line, and the other way round.
    std::vector<Block> by_next, next_by_own;
    Eigen::PartialPivLU<Eigen::MatrixXd> pivot;
    Eigen::VectorXd x;
  };
  struct Place {
    int line, at;
  };
  Place place(int cell) const;
  void fill(const std::vector<Face>& faces, const BlockSystem& system);
  Eigen::VectorXd solve_lines(const std::vector<Face>& faces, const BlockSystem& system);

  int rows_, columns_;
  std::vector<Line> lines_;  // none for one column
  Eigen::MatrixXd coupling_, eliminated_;
};

}  // namespace strandlab::transfer
