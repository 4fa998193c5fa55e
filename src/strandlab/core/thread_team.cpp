#include "strandlab/core/thread_team.hpp"

#include <system_error>

// Why the hand-over is right. One word, state_, says everything that a worker acts upon: whether the team ends, how
// many chunks the loop has and which is next. A chunk is open while next < chunks and the team does not end.
//
//  - A worker sleeps only in wait(seen), with a `seen` that shows no open chunk and no end. wait() returns once the
//    word differs from `seen`; a word that was changed and is the same again has nothing open either, so that a change
//    missed in between (a loop that others finished) is nothing to be woken for. A loop that opens and the end both
//    change the word before they notify, and no later step takes the end back: none can be missed between reading and
//    waiting.
//  - A claim is one fetch_add on the word, and what it returns names loop and chunk together. A worker that saw an open
//    chunk, was put aside and claims in a later loop gets a chunk of that loop, whose task it then reads: run() wrote
//    loop_ and call_ before the store that the claim's acquire reads from. A claim of chunk < chunks is run; run() does
//    not return, and so starts no further loop, until done_ has counted every one of them: done_ counts claims of
//    the current loop only.
//  - A claim that finds nothing open is void and only raises `next`. Each thread makes at most one per loop, since it
//    sees the raised word afterwards: next <= chunks + threads, within its 32 bits.
//  - The loop itself does not wait for a worker that sleeps or is late: the calling thread claims chunks too.

namespace strandlab {
namespace {

constexpr int kNextBits = 32;
constexpr std::uint64_t kEnd = std::uint64_t{1} << 63;
constexpr int kSpins = 4000;  // some tens of microseconds

void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

std::uint64_t chunks_of(std::uint64_t state) {
  return (state & ~kEnd) >> kNextBits;
}

std::uint64_t next_of(std::uint64_t state) {
  return state & 0xffffffffU;
}

bool ends(std::uint64_t state) {
  return (state & kEnd) != 0;
}

bool open(std::uint64_t state) {
  return next_of(state) < chunks_of(state);
}

}  // namespace

ThreadTeam::ThreadTeam(int threads) {
  try {
    for (int i = 1; i < threads; ++i) workers_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {
    // A limit on threads or memory: results do not depend on their number.
  }
}

ThreadTeam::~ThreadTeam() {
  state_.fetch_or(kEnd);
  state_.notify_all();
  for (auto& worker : workers_) worker.join();
}

void ThreadTeam::run(int chunks, const void* loop, Call call) {
  loop_ = loop;
  call_ = call;
  done_.store(0, std::memory_order_relaxed);
  state_.store(static_cast<std::uint64_t>(chunks) << kNextBits, std::memory_order_release);
  state_.notify_all();
  while (claim_and_run()) {
  }
  // What is left is in the hands of workers that are running it now.
  for (int spins = 0; done_.load(std::memory_order_acquire) < chunks;) {
    if (spins < kSpins) {
      ++spins;
      pause();
    } else {
      std::this_thread::yield();
    }
  }
}

// Runs the next chunk of the current loop; false when there is none.
bool ThreadTeam::claim_and_run() {
  if (!open(state_.load(std::memory_order_relaxed))) return false;
  const std::uint64_t claimed = state_.fetch_add(1, std::memory_order_acq_rel);
  if (!open(claimed)) return false;
  call_(loop_, static_cast<int>(next_of(claimed)));
  done_.fetch_add(1, std::memory_order_release);
  return true;
}

void ThreadTeam::work() {
  for (;;) {
    if (claim_and_run()) continue;
    const std::uint64_t seen = state_.load(std::memory_order_acquire);
    if (ends(seen)) return;
    if (open(seen)) continue;
    bool changed = false;
    for (int spins = 0; spins < kSpins && !changed; ++spins) {
      pause();
      const std::uint64_t now = state_.load(std::memory_order_relaxed);
      changed = ends(now) || open(now);
    }
    if (!changed) state_.wait(seen);
  }
}

}  // namespace strandlab
