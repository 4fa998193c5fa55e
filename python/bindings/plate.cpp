// Plates: mats in 3D, tested as they lie.
#include "strandlab/mat/plate.hpp"

#include <pybind11/stl.h>

#include <utility>

#include "bindings.hpp"
#include "observer.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/report/result_tables.hpp"
#include "strandlab/run/plate.hpp"

namespace strandlab::python {
namespace {

struct TestedPlate {
  run::FormedPlate formed;
  run::TestedPlateState state;  // as it lies
};

TestedPlate test_plate(const run::FormedPlate& formed) {
  PythonObserver observer{py::none()};
  const py::gil_scoped_release released;
  TestedPlate tested{formed, run::test_plate(formed, formed.panel, 0, observer)};
  if (!tested.state.not_testable.empty()) throw InputError(tested.state.not_testable);
  return tested;
}

py::dict plate_strands(const run::FormedPlate& formed) {
  files::CsvTable table({"strand", "layer", "kind", "x_mm", "y_mm", "length_mm", "width_mm"});
  long long number = 0;
  for (std::size_t layer = 0; layer < formed.mat.layers.size(); ++layer) {
    for (const auto& strand : formed.mat.layers[layer].strands) {
      table.add_row({number++, static_cast<long long>(layer), formed.mat.layers[layer].role, strand.cx_mm, strand.cy_mm,
                     strand.length_mm, strand.width_mm});
    }
  }
  return columns_of(table);
}

}  // namespace

void bind_plate(py::module_& module) {
  py::class_<run::FormedPlate>(module, "FormedPlate")
      .def_property_readonly("length_mm", [](const run::FormedPlate& f) { return f.mat.length_mm; })
      .def_property_readonly("width_mm", [](const run::FormedPlate& f) { return f.mat.width_mm; })
      .def_property_readonly("thickness_mm", [](const run::FormedPlate& f) { return f.panel.thickness_mm(); })
      .def_property_readonly("kg_per_m2", [](const run::FormedPlate& f) { return cases::weigh(f.c, f.mat).kg_per_m2; })
      .def("strands", &plate_strands);
  module.def("form_plate", &run::form_plate, py::arg("case"), py::call_guard<py::gil_scoped_release>());
  module.def("is_plate", &cases::has_plate_mat, py::arg("case"));

  py::class_<TestedPlate>(module, "TestedPlate")
      .def_property_readonly("warnings", [](const TestedPlate& t) { return t.state.result.warnings; })
      .def("moduli",
           [](const TestedPlate& t) { return columns_of(report::moduli_table(run::moduli_of(t.formed, {t.state}))); })
      .def("abd", [](const TestedPlate& t) {
        return columns_of(report::plate_table({{0, t.state.result}}));
      });
  module.def("test_plate", &test_plate, py::arg("formed"));
}

}  // namespace strandlab::python
