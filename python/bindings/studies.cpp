// Studies of many panels, run by forked workers: to be called in a process without other threads (_study.py starts
// one).
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <utility>

#include "bindings.hpp"
#include "observer.hpp"
#include "strandlab/study/command.hpp"

namespace strandlab::python {
namespace {

// Also hands on warnings, to on_warning(text).
class StudyObserver final : public run::Observer {
 public:
  StudyObserver(py::object on_progress, py::object on_warning)
      : python_(std::move(on_progress)), on_warning_(std::move(on_warning)) {}

  void warn(const std::string& line) override {
    const py::gil_scoped_acquire held;
    on_warning_(line);
  }
  void progress(const run::Progress& progress) override { python_.progress(progress); }
  bool cancelled() override { return python_.cancelled(); }

 private:
  PythonObserver python_;
  py::object on_warning_;
};

void run_study(const std::filesystem::path& plan, const std::filesystem::path& folder, int workers, double memory_bytes,
               bool keep_panels, py::object on_progress, py::object on_warning) {
  StudyObserver observer(std::move(on_progress), std::move(on_warning));
  study::Command command;
  command.plan = plan;
  command.folder = folder;
  command.runner = {workers, memory_bytes, keep_panels ? study::Keep::kPanels : study::Keep::kModuli};
  const py::gil_scoped_release released;
  study::run(command, observer);
}

}  // namespace

void bind_studies(py::module_& module) {
  module.def("run_study", &run_study, py::arg("plan"), py::arg("folder"), py::arg("workers"), py::arg("memory_bytes"),
             py::arg("keep_panels"), py::arg("on_progress"), py::arg("on_warning"));
}

}  // namespace strandlab::python
