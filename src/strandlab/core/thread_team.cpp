#include "strandlab/core/thread_team.hpp"

#include <algorithm>

namespace strandlab {
namespace {

constexpr int kCountBits = 24;
constexpr std::uint64_t kCountMask = (1U << kCountBits) - 1;
constexpr int kEpochShift = 2 * kCountBits;
constexpr int kSpins = 4000;  // some tens of microseconds

void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

std::uint64_t epoch_of(std::uint64_t state) {
  return state >> kEpochShift;
}

}  // namespace

ThreadTeam::ThreadTeam(int threads) {
  for (int i = 1; i < std::max(1, threads); ++i) workers_.emplace_back([this] { work(); });
}

ThreadTeam::~ThreadTeam() {
  stop_.store(true);
  state_.fetch_add(1ULL << kEpochShift);  // wakes the sleepers
  state_.notify_all();
  for (auto& worker : workers_) worker.join();
}

void ThreadTeam::run(int chunks, const void* loop, Call call) {
  loop_ = loop;
  call_ = call;
  done_.store(0, std::memory_order_relaxed);
  const std::uint64_t epoch = epoch_of(state_.load(std::memory_order_relaxed)) + 1;
  state_.store((epoch << kEpochShift) | (static_cast<std::uint64_t>(chunks) << kCountBits), std::memory_order_release);
  state_.notify_all();
  while (claim_and_run()) {
  }
  // What is left is in the hands of workers that are running it now.
  for (int spins = 0; done_.load(std::memory_order_acquire) < chunks; ++spins) {
    if (spins < kSpins)
      pause();
    else
      std::this_thread::yield();
  }
}

// Runs the next chunk of the current loop; false when there is none.
bool ThreadTeam::claim_and_run() {
  if (const auto s = state_.load(std::memory_order_relaxed); (s & kCountMask) >= ((s >> kCountBits) & kCountMask))
    return false;
  const std::uint64_t claimed = state_.fetch_add(1, std::memory_order_acq_rel);
  const auto chunk = static_cast<int>(claimed & kCountMask),
             chunks = static_cast<int>((claimed >> kCountBits) & kCountMask);
  if (chunk >= chunks) return false;
  call_(loop_, chunk);
  done_.fetch_add(1, std::memory_order_release);
  return true;
}

void ThreadTeam::work() {
  while (!stop_.load()) {
    if (claim_and_run()) continue;
    const std::uint64_t seen = state_.load(std::memory_order_acquire);
    if ((seen & kCountMask) < ((seen >> kCountBits) & kCountMask)) continue;
    bool changed = false;
    for (int spins = 0; spins < kSpins && !changed; ++spins) {
      pause();
      changed = epoch_of(state_.load(std::memory_order_relaxed)) != epoch_of(seen);
    }
    // A claim that came too late may have moved the counter since; then the wait returns at once and comes back here.
    if (!changed) state_.wait(seen);
  }
}

}  // namespace strandlab
