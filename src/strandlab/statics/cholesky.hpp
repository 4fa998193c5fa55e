// Sparse Cholesky factorisation (CHOLMOD, supernodal, BLAS on one thread).
#pragma once

#include <memory>
#include <vector>

#include "strandlab/core/error.hpp"

namespace strandlab::statics {

// Lower triangle of a symmetric matrix by columns, rows ascending.
struct LowerMatrix {
  std::vector<int> column_start;  // size n + 1
  std::vector<int> row;
  std::vector<double> value;
  int size() const { return static_cast<int>(column_start.size()) - 1; }
};

// y = A x
std::vector<double> multiply(const LowerMatrix& a, const std::vector<double>& x);

// The machine, or a limit on the process, has too little memory: it says nothing about the panel.
struct OutOfMemory : RunError {
  using RunError::RunError;
};

// How unknowns are ordered for a sparse factor: by minimum degree (AMD), or by nested dissection (METIS, or AMD where
// that is the better), which leaves less than half of the work in three dimensions.
enum class Ordering { kMinimumDegree, kDissection };

class Cholesky {
 public:
  // Orders and analyses the pattern of `matrix`. Pins OpenBLAS to one thread: fronts are too small to share. Throws
  // OutOfMemory.
  explicit Cholesky(const LowerMatrix& matrix, Ordering ordering = Ordering::kMinimumDegree);
  ~Cholesky();
  Cholesky(const Cholesky&) = delete;
  Cholesky& operator=(const Cholesky&) = delete;

  // Factorises a matrix with the pattern that was analysed. Throws RunError when it is not positive definite,
  // OutOfMemory.
  void factorise(const LowerMatrix& matrix);

  // Solution for one right-hand side with the last factor; errors are those of the factor, so refine where it matters.
  // Throws OutOfMemory.
  std::vector<double> solve(const std::vector<double>& rhs);
  // The same for several at once, which takes less time than one by one and may round differently.
  std::vector<std::vector<double>> solve(const std::vector<std::vector<double>>& rhs);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace strandlab::statics
