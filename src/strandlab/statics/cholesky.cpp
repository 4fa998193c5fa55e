#include "strandlab/statics/cholesky.hpp"

#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"

extern "C" void openblas_set_num_threads(int);

namespace strandlab::statics {
namespace {

// A view of our arrays for CHOLMOD, which does not write to them.
cholmod_sparse view(const LowerMatrix& matrix) {
  cholmod_sparse a{};
  a.nrow = a.ncol = static_cast<std::size_t>(matrix.size());
  a.nzmax = matrix.row.size();
  a.p = const_cast<int*>(matrix.column_start.data());
  a.i = const_cast<int*>(matrix.row.data());
  a.x = const_cast<double*>(matrix.value.data());
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = 1;
  a.packed = 1;
  return a;
}

double largest(const std::vector<double>& v) {
  double m = 0;
  for (const double x : v) m = std::max(m, std::abs(x));
  return m;
}

std::vector<double> residual(const LowerMatrix& a, const std::vector<double>& x, const std::vector<double>& b) {
  auto r = multiply(a, x);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = b[i] - r[i];
  return r;
}

}  // namespace

std::vector<double> multiply(const LowerMatrix& a, const std::vector<double>& x) {
  std::vector<double> y(x.size(), 0.0);
  for (int j = 0; j < a.size(); ++j) {
    double sum = 0;
    for (int k = a.column_start[j]; k < a.column_start[j + 1]; ++k) {
      const int i = a.row[k];
      sum += a.value[k] * x[i];
      if (i != j) y[i] += a.value[k] * x[j];
    }
    y[j] += sum;
  }
  return y;
}

struct Cholesky::Impl {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  cholmod_dense* solution = nullptr;  // reused by cholmod_solve2
  cholmod_dense *work_y = nullptr, *work_e = nullptr;

  Impl() {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
    openblas_set_num_threads(1);
  }
  ~Impl() {
    cholmod_free_dense(&solution, &common);
    cholmod_free_dense(&work_y, &common);
    cholmod_free_dense(&work_e, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void solve_once(const std::vector<double>& rhs, std::vector<double>& x) {
    cholmod_dense b{};
    b.nrow = b.nzmax = b.d = rhs.size();
    b.ncol = 1;
    b.x = const_cast<double*>(rhs.data());
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A, factor, &b, nullptr, &solution, nullptr, &work_y, &work_e, &common);
    if (common.status < CHOLMOD_OK) throw RunError("the linear solver ran out of memory");
    const auto* values = static_cast<const double*>(solution->x);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += values[i];
  }
};

Cholesky::Cholesky(const LowerMatrix& matrix) : impl_(std::make_unique<Impl>()) {
  auto a = view(matrix);
  impl_->common.nmethods = 1;
  impl_->common.method[0].ordering = CHOLMOD_AMD;
  impl_->factor = cholmod_analyze(&a, &impl_->common);
  if (impl_->factor == nullptr) {
    throw RunError(fmt::format("the linear solver could not analyse {} unknowns (out of memory)", matrix.size()));
  }
}

Cholesky::~Cholesky() = default;

void Cholesky::factorise(const LowerMatrix& matrix) {
  auto a = view(matrix);
  cholmod_factorize(&a, impl_->factor, &impl_->common);
  if (impl_->common.status == CHOLMOD_NOT_POSDEF) {
    throw RunError(fmt::format("the stiffness matrix is not positive definite (pivot {} of {})", impl_->factor->minor,
                               impl_->factor->n));
  }
  if (impl_->common.status < CHOLMOD_OK) {
    throw RunError(fmt::format("the linear solver ran out of memory for {} unknowns", matrix.size()));
  }
}

std::vector<std::vector<double>> Cholesky::solve(const LowerMatrix& matrix,
                                                 const std::vector<std::vector<double>>& rhs) {
  std::vector<std::vector<double>> solutions;
  for (const auto& b : rhs) {
    std::vector<double> x(b.size(), 0.0);
    impl_->solve_once(b, x);
    auto r = residual(matrix, x, b);
    for (int step = 0; step < 4; ++step) {
      auto refined = x;
      impl_->solve_once(r, refined);
      auto next = residual(matrix, refined, b);
      if (!(largest(next) < 0.5 * largest(r))) break;
      x = std::move(refined);
      r = std::move(next);
    }
    solutions.push_back(std::move(x));
  }
  return solutions;
}

double Cholesky::factor_entries() const {
  return impl_->common.lnz;
}

}  // namespace strandlab::statics
