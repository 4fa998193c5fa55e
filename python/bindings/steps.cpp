// The steps of a run in memory, and a run in a folder.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <utility>

#include "bindings.hpp"
#include "observer.hpp"
#include "strandlab/mat/mat.hpp"
#include "strandlab/profile/profile.hpp"
#include "strandlab/report/result_tables.hpp"
#include "strandlab/run/folder.hpp"
#include "strandlab/run/form.hpp"
#include "strandlab/run/journey.hpp"
#include "strandlab/run/plate.hpp"
#include "strandlab/run/press.hpp"
#include "strandlab/run/profile_bins.hpp"
#include "strandlab/run/test.hpp"

namespace strandlab::python {
namespace {

struct PressedPanels {
  std::vector<std::shared_ptr<Panel<2>>> panels;
  std::vector<press::Record> records;
  std::vector<std::string> warnings;
};

// on_state(panel, index) is called at each state kept, with the panel that is in the answer.
PressedPanels press_mat(const run::Formed& formed, py::object on_progress, const py::object& on_state) {
  PythonObserver observer(std::move(on_progress));
  PressedPanels pressed;
  press::Sink<2> keep;
  keep.snapshot = [&](const Panel<2>& panel, int index) {
    pressed.panels.push_back(std::make_shared<Panel<2>>(panel));
    if (on_state.is_none()) return;
    const py::gil_scoped_acquire held;
    on_state(pressed.panels.back(), index);
  };
  const py::gil_scoped_release released;
  pressed.records = run::press(formed, std::move(keep), std::nullopt, observer).records;
  pressed.warnings = observer.warnings;
  return pressed;
}

struct TestedPanel {
  run::TestedState state;
  std::vector<std::string> warnings;
};

TestedPanel test_panel(const cases::Case& c, const Panel<2>& panel, double compaction) {
  PythonObserver observer{py::none()};
  const py::gil_scoped_release released;
  TestedPanel tested{run::test(c, panel, compaction, observer), {}};
  tested.warnings = observer.warnings;
  return tested;
}

py::dict moduli(const run::Formed& formed, const std::vector<TestedPanel>& panels) {
  run::Tested tested;
  for (const auto& panel : panels) tested.push_back(panel.state);
  return columns_of(report::moduli_table(run::moduli_of(formed, tested)));
}

py::dict press_record(const PressedPanels& pressed) {
  return columns_of(report::press_table(pressed.records));
}

py::dict density_profile(const run::Formed& formed, const Panel<2>& panel, double compaction, int bins) {
  const auto made = without_lock([&] {
    return profile::density_profile(panel, bins > 0 ? bins : run::bins_of_one_cell(formed.c, panel, compaction));
  });
  files::CsvTable table({"height_mm", "density_kg_m3"});
  for (int i = 0; i < made.bins(); ++i)
    table.add_row({(i + 0.5) * made.bin_height_mm(), made.density_kg_m3[static_cast<std::size_t>(i)]});
  return columns_of(table);
}

py::dict strands_of(const mat::Mat& mat) {
  files::CsvTable table({"row", "kind", "x0_mm", "x1_mm", "bottom_mm", "thickness_mm"});
  for (std::size_t row = 0; row < mat.layers.size(); ++row) {
    for (const auto& strand : mat.layers[row].strands)
      table.add_row({static_cast<long long>(row), mat.layers[row].role, strand.x0_mm, strand.x1_mm,
                     mat.height_below(row), mat.thickness_of(row)});
  }
  return columns_of(table);
}

void run_in_folder(const cases::Case& c, const std::filesystem::path& folder, bool force, py::object on_progress) {
  PythonObserver observer(std::move(on_progress));
  const py::gil_scoped_release released;
  const run::Place place{folder, force};
  if (cases::has_plate_mat(c))
    run::plate(c, place, observer);
  else
    run::all(c, place, observer);
}

}  // namespace

void bind_steps(py::module_& module) {
  py::class_<run::Formed>(module, "Formed")
      .def_property_readonly("compactions", [](const run::Formed& f) { return f.c.schedule.compactions; })
      .def_property_readonly("length_mm", [](const run::Formed& f) { return f.mat.length_mm; })
      .def_property_readonly("thickness_mm", [](const run::Formed& f) { return f.mat.thickness_mm(); })
      .def_property_readonly("kg_per_m2", [](const run::Formed& f) { return cases::weigh(f.c, f.mat).kg_per_m2; })
      .def("strands", [](const run::Formed& f) { return strands_of(f.mat); })
      .def("panel", [](const run::Formed& f) { return std::make_shared<Panel<2>>(f.panel); })
      .def("text", [](const run::Formed& f) { return mat::to_text(f.mat); });
  module.def(
      "form", [](const cases::Case& c) { return run::form(c); }, py::arg("case"),
      py::call_guard<py::gil_scoped_release>());

  py::class_<PressedPanels>(module, "Pressed")
      .def_readonly("panels", &PressedPanels::panels)
      .def_readonly("warnings", &PressedPanels::warnings)
      .def("record", &press_record);
  module.def("press", &press_mat, py::arg("formed"), py::arg("on_progress"), py::arg("on_state"));

  py::class_<TestedPanel>(module, "TestedPanel")
      .def_readonly("warnings", &TestedPanel::warnings)
      .def_property_readonly("not_testable",
                             [](const TestedPanel& t) -> py::object {
                               return t.state.not_testable ? py::cast(t.state.not_testable->reason) : py::none();
                             })
      .def("slips", [](const TestedPanel& t) { return columns_of(report::slip_table(t.state.result)); });
  module.def("test", &test_panel, py::arg("case"), py::arg("panel"), py::arg("compaction"));
  module.def("moduli", &moduli, py::arg("formed"), py::arg("tested"));
  module.def("density_profile", &density_profile, py::arg("formed"), py::arg("panel"), py::arg("compaction"),
             py::arg("bins"));
  module.def("read_run_case", &run::read_run_case, py::arg("folder"));
  module.def("run_in_folder", &run_in_folder, py::arg("case"), py::arg("folder"), py::arg("force"),
             py::arg("on_progress"));
}

}  // namespace strandlab::python
