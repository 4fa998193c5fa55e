#include "strandlab/transfer/linear.hpp"

#include <algorithm>

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

}  // namespace

Elimination::Elimination(const Grid& grid) : rows_(grid.rows), columns_(grid.columns) {
  if (columns_ == 1) return;
  const auto width = static_cast<std::size_t>(std::min(rows_, columns_));
  const auto size = 3 * static_cast<Eigen::Index>(width);
  lines_.resize(static_cast<std::size_t>(std::max(rows_, columns_)));
  coupling_ = Eigen::MatrixXd::Zero(size, size);
  for (auto& line : lines_) {
    line.own = coupling_;
    line.right.resize(size);
    line.by_next.resize(width);
    line.next_by_own.resize(width);
  }
}

Elimination::Place Elimination::place(int cell) const {
  const int row = cell % rows_, column = cell / rows_;
  return columns_ <= rows_ ? Place{row, column} : Place{column, row};
}

void Elimination::fill(const std::vector<Face>& faces, const BlockSystem& system) {
  for (auto& line : lines_) line.own.setZero();
  for (int cell = 0; cell < rows_ * columns_; ++cell) {
    const auto [line, at] = place(cell);
    lines_[line].own.block<3, 3>(3L * at, 3L * at) = system.diagonal[cell];
    lines_[line].right.segment<3>(3L * at) = system.right.segment<3>(3L * cell);
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto a = place(faces[f].a), b = place(faces[f].b);
    auto& line = lines_[a.line];
    if (a.line == b.line) {
      line.own.block<3, 3>(3L * a.at, 3L * b.at) = system.a_by_b[f];
      line.own.block<3, 3>(3L * b.at, 3L * a.at) = system.b_by_a[f];
    } else {
      line.by_next[a.at] = system.a_by_b[f];
      line.next_by_own[a.at] = system.b_by_a[f];
    }
  }
}

Eigen::VectorXd Elimination::solve_lines(const std::vector<Face>& faces, const BlockSystem& system) {
  fill(faces, system);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    auto& line = lines_[i];
    if (i > 0) {
      auto& before = lines_[i - 1];
      for (std::size_t at = 0; at < before.by_next.size(); ++at) {
        const auto k = 3 * static_cast<Eigen::Index>(at);
        coupling_.block<3, 3>(k, k) = before.by_next[at];
      }
      eliminated_ = before.pivot.solve(coupling_);
      before.x = before.pivot.solve(before.right);
      for (std::size_t at = 0; at < before.by_next.size(); ++at) {
        const auto k = 3 * static_cast<Eigen::Index>(at);
        line.own.middleRows<3>(k).noalias() -= before.next_by_own[at] * eliminated_.middleRows<3>(k);
        line.right.segment<3>(k) -= before.next_by_own[at] * before.x.segment<3>(k);
      }
    }
    line.pivot.compute(line.own);
  }
  for (std::size_t i = lines_.size(); i-- > 0;) {
    auto& line = lines_[i];
    for (std::size_t at = 0; i + 1 < lines_.size() && at < line.by_next.size(); ++at) {
      const auto k = 3 * static_cast<Eigen::Index>(at);
      line.right.segment<3>(k) -= line.by_next[at] * lines_[i + 1].x.segment<3>(k);
    }
    line.x = line.pivot.solve(line.right);
  }
  Eigen::VectorXd x(system.right.size());
  for (int cell = 0; cell < rows_ * columns_; ++cell) {
    const auto [line, at] = place(cell);
    x.segment<3>(3L * cell) = lines_[line].x.segment<3>(3L * at);
  }
  return x;
}

Eigen::VectorXd Elimination::solve(const std::vector<Face>& faces, const BlockSystem& system) {
  auto x = columns_ == 1 ? solve_column(system) : solve_lines(faces, system);
  return x.allFinite() ? x : Eigen::VectorXd();
}

}  // namespace strandlab::transfer
