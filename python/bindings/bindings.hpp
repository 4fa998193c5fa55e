// The laboratory as a Python module: strandlab._core. What a user sees of it is in python/strandlab/__init__.py; what
// stands here is as near to the library as Python allows.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "strandlab/files/csv.hpp"

namespace strandlab::python {

namespace py = pybind11;

// Columns by name: lists of numbers are NumPy arrays, others lists of str.
py::dict columns_of(const files::CsvTable& table);

// Calls work() while other threads of Python run: it must not touch anything of Python.
template <class Work>
auto without_lock(const Work& work) {
  const py::gil_scoped_release released;
  return work();
}

void bind_case(py::module_& module);
void bind_panel(py::module_& module);
void bind_steps(py::module_& module);
void bind_answers(py::module_& module);
void bind_studies(py::module_& module);
void bind_plate(py::module_& module);

}  // namespace strandlab::python
