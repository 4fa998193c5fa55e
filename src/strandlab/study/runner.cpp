#include "strandlab/study/runner.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iterator>
#include <new>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "strandlab/core/error.hpp"
#include "strandlab/core/free_memory.hpp"
#include "strandlab/run/duration.hpp"
#include "strandlab/study/claim.hpp"

namespace strandlab::study {
namespace {

using Clock = std::chrono::steady_clock;

int cores() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// How far a worker is with its item, 0..1, in memory that it shares with its parent.
class SharedFraction {
 public:
  SharedFraction() {
    auto* place = ::mmap(nullptr, sizeof(Value), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (place == MAP_FAILED) throw RunError(fmt::format("no memory to share with a worker: {}", std::strerror(errno)));
    value_ = new (place) Value(0);
  }
  ~SharedFraction() {
    if (value_) ::munmap(value_, sizeof(Value));
  }
  SharedFraction(SharedFraction&& other) noexcept : value_(std::exchange(other.value_, nullptr)) {}
  SharedFraction& operator=(SharedFraction&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  SharedFraction(const SharedFraction&) = delete;
  SharedFraction& operator=(const SharedFraction&) = delete;
  void set(double fraction) { *value_ = fraction; }
  double get() const { return *value_; }

 private:
  using Value = std::atomic<double>;
  Value* value_ = nullptr;
};

// A worker's observer: its log is in the item's folder, its parent sees how far it is.
class Teller final : public run::Observer {
 public:
  explicit Teller(SharedFraction& fraction) : fraction_(fraction) {}
  void progress(const run::Progress& progress) override {
    constexpr double kPressing = 0.9;  // share of an item's time, for the eye
    fraction_.set(progress.step == "press" ? kPressing * progress.fraction
                                           : kPressing + (1 - kPressing) * progress.fraction);
  }

 private:
  SharedFraction& fraction_;
};

struct Worker {
  const Item* item = nullptr;
  pid_t process = 0;
  SharedFraction fraction;
};

// The life of a worker; what fails is in the item's record. Ends without what belongs to the parent: buffers, locks.
[[noreturn]] void work_and_exit(const Study& study, const Item& item, const Work& work, std::optional<Claim> pressing,
                                SharedFraction& fraction, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // the parent was killed before
  Teller teller(fraction);
  try {
    run_item(study, item, work, std::move(pressing), teller);
    ::_exit(0);
  } catch (...) {
    ::_exit(1);
  }
}

// A child has the thread that forks only: locks that others hold, in the libraries, would stay locked in it for ever.
void refuse_other_threads() {
  const auto threads = std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
  if (threads > 1)
    throw RunError(
        fmt::format("items are run by forked processes, and this one has {} threads: run the study from a "
                    "process of its own, strandlab study run",
                    threads));
}

class Runner {
 public:
  Runner(const Study& study, const RunnerOptions& options, run::Observer& observer)
      : study_(study), observer_(observer), memory_(options.memory_bytes) {
    for (const auto& item : study.items) {
      all_seconds_ += item.seconds;
      if (read_record(study, item).whole) {
        done_seconds_ += item.seconds;
        ++whole_;
      } else {
        waiting_.push_back(&item);
      }
    }
    found_seconds_ = done_seconds_;
    workers_ = worker_count(options, waiting_.size());
    work_ = {std::max(1, cores() / std::max(1, workers_)), options.keep};
    if (!(memory_ > 0)) memory_ = free_memory_bytes();
  }
  ~Runner() { end_workers(); }
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  std::vector<Failure> run() {
    using namespace std::chrono_literals;
    const auto count = waiting_.size();
    observer_.say(fmt::format("study: {} of {} items to do, {} at a time on {} thread(s) each", count,
                              study_.items.size(), workers_, work_.threads));
    while (!waiting_.empty() || !running_.empty()) {
      const bool started = start_what_fits();
      const bool ended = collect_ended();
      tell();
      run::stop_if_cancelled(observer_);
      if (!started && !ended) std::this_thread::sleep_for(running_.empty() ? 100ms : 3ms);
    }
    return std::move(failures_);
  }

 private:
  bool start_what_fits() {
    bool started = false;
    for (auto at = waiting_.begin(); at != waiting_.end() && static_cast<int>(running_.size()) < workers_;) {
      const auto& item = **at;
      if (item.bytes > memory_) {
        fail(item, fmt::format("needs {:.0f} MB of memory, the study may take {:.0f} MB (--memory-MB)",
                               item.bytes / 1e6, memory_ / 1e6));
        at = waiting_.erase(at);
        continue;
      }
      if (memory_in_use() + item.bytes > memory_) break;
      const auto outcome = start(item);
      if (outcome == Start::kBusy) {
        ++at;
      } else {
        started = started || outcome == Start::kStarted;
        at = waiting_.erase(at);
      }
    }
    return started;
  }

  enum class Start { kStarted, kWhole, kFailed, kBusy };

  Start start(const Item& item) {
    try {
      auto claim = Claim::attempt(study_.item_folder(item));
      if (!claim) return Start::kBusy;
      if (read_record(study_, item).whole) {  // another `study run` has done it
        finish(item);
        return Start::kWhole;
      }
      auto pressing = Claim::attempt(study_.pressing_folder(item));
      if (!pressing) return Start::kBusy;
      fork_worker(item, std::move(pressing));
      return Start::kStarted;
    } catch (const std::runtime_error& e) {  // InputError or RunError
      fail(item, e.what());
      return Start::kFailed;
    }
  }

  // The claims go on in the child when they end here.
  void fork_worker(const Item& item, std::optional<Claim> pressing) {
    Worker worker;
    worker.item = &item;
    std::fflush(nullptr);
    const pid_t parent = ::getpid();
    worker.process = ::fork();
    if (worker.process == 0) work_and_exit(study_, item, work_, std::move(pressing), worker.fraction, parent);
    if (worker.process < 0) throw RunError(fmt::format("cannot start a worker: {}", std::strerror(errno)));
    running_.push_back(std::move(worker));
  }

  bool collect_ended() {
    bool ended = false;
    for (auto at = running_.begin(); at != running_.end();) {
      int status = 0;
      const pid_t process = ::waitpid(at->process, &status, WNOHANG);
      if (process == 0 || (process < 0 && errno == EINTR)) {
        ++at;
        continue;
      }
      const auto& item = *at->item;
      at = running_.erase(at);
      ended = true;
      if (process > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0)
        finish(item);
      else
        lose(item, process > 0 && WIFSIGNALED(status) ? WTERMSIG(status) : 0);
    }
    return ended;
  }

  void finish(const Item& item) {
    done_seconds_ += item.seconds;
    ++whole_;
  }

  // A worker that ended without a whole item: by its own word in the record, or by a signal.
  void lose(const Item& item, int signal) {
    const auto record = read_record(study_, item);
    if (signal == 0 && !record.error.empty()) {
      note(item, record.error);
    } else if (signal == 0) {
      fail(item, "its worker ended without a word: is the disk full? See log.txt of the item");
    } else {
      fail(item, fmt::format("its worker was ended by signal {} ({}){}", signal, ::strsignal(signal),
                             signal == SIGKILL ? "; was there not enough memory?" : ""));
    }
  }

  void fail(const Item& item, const std::string& error) {
    try_to_record_failure(study_, item, error, observer_);
    note(item, error);
  }

  void note(const Item& item, const std::string& error) {
    all_seconds_ -= item.seconds;
    failures_.push_back({item.number, error});
    observer_.warn(fmt::format("item {} failed: {}", item.number, error));
  }

  double memory_in_use() const {
    double bytes = 0;
    for (const auto& worker : running_) bytes += worker.item->bytes;
    return bytes;
  }

  // By the estimates, held against the time that what is done since the start has taken.
  void tell() {
    using namespace std::chrono_literals;
    const auto now = Clock::now();
    if (now - told_ < 200ms) return;
    told_ = now;
    double done = done_seconds_;
    for (const auto& worker : running_) done += worker.fraction.get() * worker.item->seconds;
    const double fresh = done - found_seconds_, elapsed = std::chrono::duration<double>(now - begin_).count();
    const auto left = fresh > 0 ? run::duration((all_seconds_ - done) * elapsed / fresh) : std::string("unknown time");
    observer_.progress({"study", all_seconds_ > 0 ? done / all_seconds_ : 1,
                        fmt::format("{} of {} items done, {} failed, {} at work, {} left", whole_, study_.items.size(),
                                    failures_.size(), running_.size(), left)});
  }

  void end_workers() {
    for (const auto& worker : running_) ::kill(worker.process, SIGKILL);
    for (const auto& worker : running_) {
      while (::waitpid(worker.process, nullptr, 0) < 0 && errno == EINTR) continue;
    }
    running_.clear();
  }

  const Study& study_;
  run::Observer& observer_;
  Work work_;
  double memory_ = 0;
  int workers_ = 1;
  std::vector<const Item*> waiting_;
  std::vector<Worker> running_;
  std::vector<Failure> failures_;
  std::size_t whole_ = 0;
  double all_seconds_ = 0, done_seconds_ = 0, found_seconds_ = 0;  // estimated; found_seconds_ was done before
  Clock::time_point begin_ = Clock::now(), told_ = begin_;
};

}  // namespace

int worker_count(const RunnerOptions& options, std::size_t items) {
  const int most = options.workers > 0 ? options.workers : cores();
  return std::max(1, static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(most), items)));
}

std::vector<Failure> run_items(const Study& study, const RunnerOptions& options, run::Observer& observer) {
  refuse_other_threads();
  return Runner(study, options, observer).run();
}

}  // namespace strandlab::study
