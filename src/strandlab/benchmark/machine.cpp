#include "strandlab/benchmark/machine.hpp"

#include <omp.h>

#include <algorithm>
#include <vector>

namespace strandlab::benchmark {
namespace {

// Independent chains of multiply-adds, enough to fill the pipelines; compiled for several instruction sets where the
// compiler can.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
__attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4"), optimize("O3")))
#endif
double
fma_chains(long rounds) {
  constexpr int kChains = 128;
  double a[kChains];
  for (int i = 0; i < kChains; ++i) a[i] = 1.0 + 1e-3 * i;
  for (long k = 0; k < rounds; ++k) {
    for (double& x : a) x = x * 0.999999 + 1e-6;
  }
  double sum = 0;
  for (double x : a) sum += x;
  return sum;
}

double fma_gflops(int threads) {
  constexpr long kRounds = 2000000;
  constexpr double kFlops = 2.0 * 128 * kRounds;
  double best = 0;
  for (int trial = 0; trial < 3; ++trial) {
    double check = 0;
    const double start = omp_get_wtime();
#pragma omp parallel for num_threads(threads) reduction(+ : check) schedule(static, 1)
    for (int t = 0; t < threads; ++t) check += fma_chains(kRounds + (t < 0));
    const double seconds = omp_get_wtime() - start;
    if (check > 0) best = std::max(best, threads * kFlops / seconds / 1e9);
  }
  return best;
}

double triad_gb_s(int threads) {
  constexpr long kSize = 8L << 20;  // 64 MB an array
  std::vector<double> a(kSize), b(kSize, 1.0), c(kSize, 2.0);
  double best = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const double start = omp_get_wtime();
#pragma omp parallel for num_threads(threads) schedule(static)
    for (long i = 0; i < kSize; ++i) a[i] = b[i] + 0.5 * c[i];
    const double seconds = omp_get_wtime() - start;
    std::swap(a, b);
    best = std::max(best, 3.0 * kSize * sizeof(double) / seconds / 1e9);
  }
  return best;
}

}  // namespace

MachineLimits machine_limits(int threads) {
  return {fma_gflops(threads), triad_gb_s(threads)};
}

}  // namespace strandlab::benchmark
