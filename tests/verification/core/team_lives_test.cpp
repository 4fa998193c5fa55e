// Teams of threads that are made, run one loop and end, a million times: none may sleep through its end. A worker that
// read "go on", was put aside and then slept on a word that already told the end hung a team of four within 40,000.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "strandlab/core/thread_team.hpp"

namespace strandlab {
namespace {

#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr int kShare = 100;  // a sanitized life costs many times a plain one
#else
constexpr int kShare = 1;
#endif

// Task i adds i + 1: the sum says that every task of every life has run.
void live(int lives, int threads) {
  const int tasks = 2 * threads;
  for (int life = 0; life < lives; ++life) {
    std::atomic<int> sum{0};
    {
      ThreadTeam team(threads);
      team.for_each(tasks, 1, [&](int i) { sum += i + 1; });
      ASSERT_EQ(sum.load(), tasks * (tasks + 1) / 2) << "life " << life;
    }
  }
}

// The million in quarters, so that they run beside each other; ./check lives one of them.
class TeamLives : public testing::TestWithParam<int> {};

TEST_P(TeamLives, OfTwoEnd) {
  live(220000 / kShare, 2);
}

// The more threads the sooner one is put aside at the wrong moment.
TEST_P(TeamLives, OfFourEnd) {
  live(30000 / kShare, 4);
}

// The hang that they watch for came within 40,000 lives; the other three quarters are long.
INSTANTIATE_TEST_SUITE_P(Quarter, TeamLives, testing::Range(1, 2));
INSTANTIATE_TEST_SUITE_P(NightlyQuarters, TeamLives, testing::Range(2, 5));

// More threads than cores, all busy: workers are put aside anywhere.
TEST(TeamOfThreads, EndsBesideOtherLoad) {
  std::atomic<bool> stop{false};
  std::vector<std::thread> others;
  for (unsigned i = 0; i < std::thread::hardware_concurrency() + 1; ++i) {
    others.emplace_back([&] {
      while (!stop.load(std::memory_order_relaxed)) {
      }
    });
  }
  live(10000 / kShare, 4);
  stop = true;
  for (auto& other : others) other.join();
}

// A loop of more chunks than 24 bits hold, which is what the hand-over's word once had room for, runs each of them.
TEST(TeamOfThreads, MillionsOfChunks) {
  ThreadTeam team(2);
  constexpr int kCount = (1 << 24) + 5;
  std::atomic<int> tasks{0};
  team.for_each(kCount, 1, [&](int) { tasks.fetch_add(1, std::memory_order_relaxed); });
  EXPECT_EQ(tasks.load(), kCount);
}

// Long pauses between loops let the workers fall asleep, short ones catch them on the way to it.
TEST(TeamOfThreads, LoopsWakeSleepers) {
  ThreadTeam team(4);
  for (int round = 0; round < 2000; ++round) {
    std::this_thread::sleep_for(std::chrono::microseconds(round % 200));
    std::atomic<int> sum{0};
    team.for_each(8, 1, [&](int i) { sum += i + 1; });
    ASSERT_EQ(sum.load(), 36) << "round " << round;
  }
}

}  // namespace
}  // namespace strandlab
