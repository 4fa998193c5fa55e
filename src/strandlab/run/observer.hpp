// Who watches a run: is told what happens, and may stop it. A terminal is one, a notebook or a service another.
#pragma once

#include <string>

#include "strandlab/core/error.hpp"

namespace strandlab::run {

struct Progress {
  std::string step;     // "press", "test", "hotpress"
  double fraction = 0;  // of this step, 0..1
  std::string detail;   // for people: "compaction 0.131 of 0.4  step 5210  ..."
};

// "press   33 %  compaction 0.131 of 0.4  step 5210  ...".
std::string line_of(const Progress& progress);

// Does nothing and never stops; derive to watch. Called by the thread that runs the step only. What a function throws
// ends the run and passes through.
class Observer {
 public:
  Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  virtual ~Observer() = default;

  virtual void say(const std::string& /*line*/) {}
  virtual void warn(const std::string& /*line*/) {}
  virtual void progress(const Progress& /*progress*/) {}  // a few times a second; "hotpress" after every step
  // Asked before every time step and every solution of equations, so it must be quick: true ends the run within a
  // second by Cancelled. A run folder then holds what the run goes on from.
  virtual bool cancelled() { return false; }
};

inline void stop_if_cancelled(Observer& observer) {
  if (observer.cancelled()) throw Cancelled();
}

}  // namespace strandlab::run
