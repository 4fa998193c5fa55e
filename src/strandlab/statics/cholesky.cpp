#include "strandlab/statics/cholesky.hpp"

#include <cholmod.h>
#include <fmt/format.h>
#include <sys/mman.h>

#include <utility>

extern "C" void openblas_set_num_threads(int);
extern "C" void dsyrk_(const char* uplo, const char* trans, const int* n, const int* k, const double* alpha,
                       const double* a, const int* lda, const double* beta, double* c, const int* ldc);

namespace strandlab::statics {
namespace {

// OpenBLAS takes a buffer at its first product and keeps it; where there is none to be had it asks for ever. So it is
// asked for when it is known to be there, once, before CHOLMOD needs memory of its own. Throws RunError where it is
// not.
void take_blas_buffer() {
  constexpr std::size_t kBuffer = std::size_t{129} << 20;  // bytes: BUFFER_SIZE of OpenBLAS on 64-bit machines, a page
  static const bool taken = [] {
    void* place = ::mmap(nullptr, kBuffer, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (place == MAP_FAILED) {
      throw OutOfMemory(
          fmt::format("the linear solver needs {} MB of address space for its buffer and more for its factor; "
                      "allow the process more memory (ulimit -v)",
                      kBuffer >> 20));
    }
    ::munmap(place, kBuffer);
    openblas_set_num_threads(1);
    const int one = 1;
    const double number = 1;
    double result = 0;
    dsyrk_("L", "N", &one, &one, &number, &number, &one, &number, &result, &one);
    return true;
  }();
  static_cast<void>(taken);
}

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
    take_blas_buffer();
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
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
};

Cholesky::Cholesky(const LowerMatrix& matrix, Ordering ordering) : impl_(std::make_unique<Impl>()) {
  auto a = view(matrix);
  auto& common = impl_->common;
  common.nmethods = 0;
  if (ordering == Ordering::kDissection) common.method[common.nmethods++].ordering = CHOLMOD_METIS;
  common.method[common.nmethods++].ordering = CHOLMOD_AMD;
  impl_->factor = cholmod_analyze(&a, &impl_->common);
  if (impl_->factor == nullptr) {
    throw OutOfMemory(fmt::format("the linear solver could not analyse {} unknowns (out of memory)", matrix.size()));
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
    throw OutOfMemory(fmt::format("the linear solver ran out of memory for {} unknowns", matrix.size()));
  }
}

std::vector<double> Cholesky::solve(const std::vector<double>& rhs) {
  return std::move(solve(std::vector<std::vector<double>>{rhs}).front());
}

std::vector<std::vector<double>> Cholesky::solve(const std::vector<std::vector<double>>& rhs) {
  const std::size_t size = rhs.front().size();
  std::vector<double> columns;
  columns.reserve(size * rhs.size());
  for (const auto& column : rhs) columns.insert(columns.end(), column.begin(), column.end());
  cholmod_dense b{};
  b.nrow = b.d = size;
  b.ncol = rhs.size();
  b.nzmax = columns.size();
  b.x = columns.data();
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  auto& i = *impl_;
  cholmod_solve2(CHOLMOD_A, i.factor, &b, nullptr, &i.solution, nullptr, &i.work_y, &i.work_e, &i.common);
  if (i.common.status < CHOLMOD_OK) throw OutOfMemory("the linear solver ran out of memory");
  const auto* values = static_cast<const double*>(i.solution->x);
  std::vector<std::vector<double>> solutions;
  for (std::size_t k = 0; k < rhs.size(); ++k) solutions.emplace_back(values + k * size, values + (k + 1) * size);
  return solutions;
}

}  // namespace strandlab::statics
