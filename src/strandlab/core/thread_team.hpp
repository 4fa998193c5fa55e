// A few threads that share loops of independent tasks, many thousand loops a second.
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace strandlab {

// Tasks are claimed one by one, so a loop ends when its tasks are done, not when every thread has shown up: a thread
// that the system has put aside (a busy machine) delays nobody unless it holds a task. Workers spin for some
// microseconds between loops, then sleep. Tasks must not throw and must not depend on each other; which thread runs one
// is left open.
class ThreadTeam {
 public:
  // `threads` includes the calling thread; at least 1. Where the system gives fewer, the team is as large as it gives.
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int threads() const { return static_cast<int>(workers_.size()) + 1; }

  // task(i) for 0 <= i < count, `chunk` successive ones by the same thread. Called by one thread at a time, not from a
  // task.
  template <class Task>
  void for_each(int count, int chunk, const Task& task) {
    if (workers_.empty() || count <= chunk) {
      for (int i = 0; i < count; ++i) task(i);
      return;
    }
    const Loop<Task> loop{&task, count, chunk};
    run((count - 1) / chunk + 1, &loop, [](const void* data, int number) {
      const auto& l = *static_cast<const Loop<Task>*>(data);
      const int begin = number * l.chunk, end = l.count - begin > l.chunk ? begin + l.chunk : l.count;
      for (int i = begin; i < end; ++i) (*l.task)(i);
    });
  }

 private:
  template <class Task>
  struct Loop {
    const Task* task;
    int count, chunk;
  };
  using Call = void (*)(const void* loop, int chunk_number);

  void run(int chunks, const void* loop, Call call);
  bool claim_and_run();
  void work();

  // The end of the team (1 bit), number of chunks of the loop (31), next chunk (32): all that a worker waits for is in
  // this one word (thread_team.cpp).
  std::atomic<std::uint64_t> state_{0};
  std::atomic<int> done_{0};
  const void* loop_ = nullptr;
  Call call_ = nullptr;
  std::vector<std::thread> workers_;
};

}  // namespace strandlab
