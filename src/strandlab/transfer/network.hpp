// The equations of all cells at one time: what they hold, what they receive, and the derivatives of both.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "strandlab/transfer/solver.hpp"

namespace strandlab::transfer {

using Block = Eigen::Matrix3d;  // by Row and unknown (T, M, p_a)

struct Equations {
  Eigen::VectorXd holds, receives;  // by 3 * cell + Row; receives: per second
  Amounts crossing{};               // of it, through boundaries and edges, mean over the columns
  // Derivatives of a cell's rows by its own unknowns, and of the rows of a face's cells by the unknowns across it.
  std::vector<Block> holds_by_own, receives_by_own;  // by cell
  std::vector<Block> a_by_b, b_by_a;                 // by face
};

// Values alone; the derivatives stay empty.
Equations values_at(const Constants& constants, const Grid& grid, const std::vector<CellState>& state,
                    const Conditions& conditions);
Equations equations_at(const Constants& constants, const Grid& grid, const std::vector<CellState>& state,
                       const Conditions& conditions);

}  // namespace strandlab::transfer
