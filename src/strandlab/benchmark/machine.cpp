#include "strandlab/benchmark/machine.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <vector>

#include "strandlab/core/thread_team.hpp"

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

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double fma_gflops(ThreadTeam& team) {
  constexpr long kRounds = 2000000;
  constexpr double kFlops = 2.0 * 128 * kRounds;
  const int threads = team.threads();
  std::vector<double> sums(static_cast<std::size_t>(threads));
  double best = 0;
  for (int trial = 0; trial < 3; ++trial) {
    const double start = seconds();
    team.for_each(threads, 1, [&](int t) { sums[static_cast<std::size_t>(t)] = fma_chains(kRounds); });
    const double gflops = threads * kFlops / (seconds() - start) / 1e9;
    if (std::accumulate(sums.begin(), sums.end(), 0.0) > 0) best = std::max(best, gflops);  // the sums are used
  }
  return best;
}

double triad_gb_s(ThreadTeam& team) {
  constexpr long kSize = 8L << 20;  // 64 MB an array
  constexpr int kParts = 64;
  std::vector<double> a(kSize), b(kSize, 1.0), c(kSize, 2.0);
  double best = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const double start = seconds();
    team.for_each(kParts, 1, [&](int part) {
      const long begin = kSize / kParts * part;
      for (long i = begin; i < begin + kSize / kParts; ++i) a[i] = b[i] + 0.5 * c[i];
    });
    best = std::max(best, 3.0 * kSize * sizeof(double) / (seconds() - start) / 1e9);
    std::swap(a, b);
  }
  return best;
}

}  // namespace

MachineLimits machine_limits(int threads) {
  ThreadTeam team(threads);
  return {fma_gflops(team), triad_gb_s(team)};
}

}  // namespace strandlab::benchmark
