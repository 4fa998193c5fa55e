// Panels, strands and their fields: arrays are views of the library's memory, read-only, and keep their panel alive.
#include "strandlab/panel/panel.hpp"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>

#include "bindings.hpp"
#include "strandlab/io/checkpoint.hpp"
#include "strandlab/io/vtk.hpp"
#include "strandlab/lattice/points.hpp"

namespace strandlab::python {
namespace {

// A view of doubles that `owner` holds: one value per row.
template <class Value>
py::array view_of(const std::vector<Value>& values, py::handle owner) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(values.size())}, strides{sizeof(Value)};
  const double* data = nullptr;
  if constexpr (std::is_same_v<Value, double>) {
    data = values.data();
  } else {
    data = values.empty() ? nullptr : values.front().data();
    shape.push_back(Value::RowsAtCompileTime);
    strides.push_back(sizeof(double));
    if constexpr (Value::ColsAtCompileTime > 1) {  // column by column
      shape.push_back(Value::ColsAtCompileTime);
      strides.push_back(sizeof(double) * Value::RowsAtCompileTime);
    }
  }
  py::array view(py::dtype::of<double>(), shape, strides, data, owner);
  py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return view;
}

template <class Value>
py::array copy_of(const std::vector<Value>& values) {
  auto* kept = new std::vector<Value>(values);
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Value>*>(p); });
  return view_of(*kept, owner);
}

py::dict fields_of(const py::object& self) {
  const auto& strand = self.cast<const Strand<2>&>();
  py::dict fields;
  for_each_field_of<2>(strand.points,
                       [&](const auto& field) { fields[field.name] = view_of(strand.points.*field.values, self); });
  return fields;
}

py::dict field_units() {
  py::dict units;
  for_each_field<2>([&](const auto& field) { units[field.name] = py::make_tuple(field.unit, field.description); });
  return units;
}

py::array cells_of(const Strand<2>& strand) {
  py::array_t<long long> cells({static_cast<py::ssize_t>(strand.size()), py::ssize_t{4}});
  auto at = cells.mutable_unchecked<2>();
  for (std::size_t p = 0; p < strand.size(); ++p) {
    const auto corners = strand.lattice.cell(p);
    for (std::size_t k = 0; k < corners.size(); ++k)
      at(static_cast<py::ssize_t>(p), static_cast<py::ssize_t>(k)) = static_cast<long long>(corners[k]);
  }
  cells.attr("setflags")(py::arg("write") = false);
  return cells;
}

}  // namespace

void bind_panel(py::module_& module) {
  py::class_<Strand<2>>(module, "Strand")
      .def_readonly("kind", &Strand<2>::kind)
      .def_readonly("row", &Strand<2>::row)
      .def_readonly("angle_deg", &Strand<2>::angle_deg)
      .def_property_readonly(
          "counts", [](const Strand<2>& s) { return py::make_tuple(s.lattice.counts[0], s.lattice.counts[1]); })
      .def_property_readonly(
          "spacing_mm", [](const Strand<2>& s) { return py::make_tuple(s.lattice.spacing[0], s.lattice.spacing[1]); })
      .def_property_readonly("fields", &fields_of)
      .def("corners", [](const Strand<2>& s) { return copy_of(corners(s)); })
      .def("cells", &cells_of)
      .def("__len__", &Strand<2>::size);
  py::class_<Panel<2>, std::shared_ptr<Panel<2>>>(module, "Panel")
      .def_readonly("length_mm", &Panel<2>::length_mm)
      .def_readonly("bottom_mm", &Panel<2>::bottom_mm)
      .def_readonly("top_mm", &Panel<2>::top_mm)
      .def_readonly("time_s", &Panel<2>::time_s)
      .def_property_readonly("thickness_mm", &Panel<2>::thickness_mm)
      .def_property_readonly("compaction", &Panel<2>::compaction)
      .def_property_readonly("strands",
                             [](const py::object& self) {
                               py::list strands;
                               for (auto& strand : self.cast<Panel<2>&>().strands)
                                 strands.append(py::cast(&strand, py::return_value_policy::reference_internal, self));
                               return strands;
                             })
      .def("to_vtk", &io::write_vtu<2>, py::arg("file"), py::call_guard<py::gil_scoped_release>());
  module.def("field_units", &field_units);
  module.def(
      "read_panel",
      [](const std::filesystem::path& file) { return std::make_shared<Panel<2>>(io::read_panel<2>(file, "")); },
      py::arg("file"));
}

}  // namespace strandlab::python
