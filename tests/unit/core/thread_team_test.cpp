// Loops shared by a team of threads: every task runs exactly once, whatever the count and the chunks.
#include "strandlab/core/thread_team.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace strandlab {
namespace {

TEST(ThreadTeam, RunsEveryTaskOnce) {
  for (int threads : {1, 2, 3, 8}) {
    ThreadTeam team(threads);
    EXPECT_EQ(team.threads(), threads);
    for (int count : {0, 1, 2, 7, 100, 1000}) {
      for (int chunk : {1, 2, 64}) {
        std::vector<std::atomic<int>> runs(static_cast<std::size_t>(count));
        team.for_each(count, chunk, [&](int i) { ++runs[static_cast<std::size_t>(i)]; });
        for (const auto& r : runs) EXPECT_EQ(r.load(), 1);
      }
    }
  }
}

// The result of a loop is visible after it, and loops follow each other: many short ones, each reading the one before.
TEST(ThreadTeam, LoopsFollowEachOther) {
  ThreadTeam team(4);
  std::vector<long> values(257, 0), next(values.size());
  for (int round = 0; round < 20000; ++round) {
    team.for_each(static_cast<int>(values.size()), 3, [&](int i) {
      const auto k = static_cast<std::size_t>(i);
      next[k] = values[(k + 1) % values.size()] + 1;
    });
    values.swap(next);
  }
  for (long v : values) EXPECT_EQ(v, 20000);
}

}  // namespace
}  // namespace strandlab
