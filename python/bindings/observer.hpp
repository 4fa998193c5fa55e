// A run that Python watches: progress goes to a function, Ctrl-C ends the run.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <string>
#include <vector>

#include "strandlab/run/observer.hpp"

namespace strandlab::python {

namespace py = pybind11;

// Made with the interpreter held; the run goes on without it, and takes it to call back.
class PythonObserver final : public run::Observer {
 public:
  // on_progress(step, fraction, detail), or None.
  explicit PythonObserver(py::object on_progress) : on_progress_(std::move(on_progress)) {}

  void say(const std::string& line) override { said.push_back(line); }
  void warn(const std::string& line) override { warnings.push_back(line); }
  void progress(const run::Progress& p) override {
    if (on_progress_.is_none()) return;
    const py::gil_scoped_acquire held;
    on_progress_(p.step, p.fraction, p.detail);
  }
  // Asks the interpreter for signals a few times a second: KeyboardInterrupt, or what a handler throws, passes through.
  bool cancelled() override {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_question_) return false;
    next_question_ = now + std::chrono::milliseconds(200);
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    return false;
  }

  std::vector<std::string> said, warnings;

 private:
  py::object on_progress_;
  std::chrono::steady_clock::time_point next_question_{};
};

}  // namespace strandlab::python
