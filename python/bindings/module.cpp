#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <variant>

#include "bindings.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/version.hpp"

namespace strandlab::python {
namespace {

bool is_number(const files::CsvCell& cell) {
  return !std::holds_alternative<std::string>(cell);
}

py::object column_of(const files::CsvTable& table, std::size_t column) {
  bool numbers = true, whole = true;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto& cell = table.row(row)[column];
    numbers = numbers && is_number(cell);
    whole = whole && std::holds_alternative<long long>(cell);
  }
  if (!numbers) {
    py::list texts;
    for (std::size_t row = 0; row < table.rows(); ++row)
      texts.append(std::visit([](const auto& value) -> py::object { return py::cast(value); }, table.row(row)[column]));
    return texts;
  }
  const auto fill = [&](auto array) -> py::object {
    using Number = typename decltype(array)::value_type;
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const auto& cell = table.row(row)[column];
      const auto* count = std::get_if<long long>(&cell);
      array.mutable_at(row) = count ? static_cast<Number>(*count) : static_cast<Number>(std::get<double>(cell));
    }
    return array;
  };
  const auto rows = static_cast<py::ssize_t>(table.rows());
  return whole && rows > 0 ? fill(py::array_t<long long>(rows)) : fill(py::array_t<double>(rows));
}

}  // namespace

py::dict columns_of(const files::CsvTable& table) {
  py::dict columns;
  for (std::size_t i = 0; i < table.columns().size(); ++i) columns[py::str(table.columns()[i])] = column_of(table, i);
  return columns;
}

}  // namespace strandlab::python

PYBIND11_MODULE(_core, module) {
  using namespace strandlab;
  using namespace strandlab::python;
  module.doc() = "What strandlab is made of; import strandlab.";
  module.attr("__version__") = version();
  // The library says everything in one message; Python's users catch it by what went wrong.
  auto input = py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
  input.attr("__doc__") = "The input cannot be used: the message says what was given, where, and what is allowed.";
  auto run = py::register_exception<RunError>(module, "RunError", PyExc_RuntimeError);
  run.attr("__doc__") = "A simulation cannot go on: the message says where and when.";
  for (const py::handle error : {py::handle(input), py::handle(run)}) error.attr("__module__") = "strandlab";
  bind_case(module);
  bind_panel(module);
  bind_steps(module);
  bind_answers(module);
  bind_studies(module);
  bind_plate(module);
}
