// A case in Python: keys by path, checked together whenever one changes.
#include "strandlab/case/case.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>

#include "bindings.hpp"
#include "strandlab/case/keys.hpp"
#include "strandlab/case/write.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/nearest.hpp"

namespace strandlab::python {
namespace {

using cases::Case;
using cases::Key;

// A key and the name that stands for the * of its path.
struct Place {
  const Key* key = nullptr;
  std::string name;
};

// Every key that the case has, in the order of its file.
std::vector<std::pair<std::string, Place>> places_in(const Case& c) {
  std::vector<std::pair<std::string, Place>> places;
  for (const auto& section : cases::sections()) {
    for (const auto& name : cases::instances(c, section.path)) {
      for (const auto& key : cases::keys()) {
        if (cases::section_of(key) == section.path) places.push_back({cases::with_name(key.path, name), {&key, name}});
      }
    }
  }
  return places;
}

std::vector<std::string> paths_in(const Case& c) {
  std::vector<std::string> paths;
  for (const auto& [path, place] : places_in(c)) {
    if (!cases::is_foreign(*place.key, c) || path == "mat.width_mm")
      paths.push_back(path);  // the key that makes a plate
  }
  return paths;
}

Place place_of(const Case& c, const std::string& path) {
  for (const auto& [known, place] : places_in(c)) {
    if (known == path) return place;
  }
  const auto near = nearest(path, paths_in(c));
  throw py::key_error(
      fmt::format("this case has no key {}{}", path, near.empty() ? "" : fmt::format("; did you mean {}?", near)));
}

py::object get(const Case& c, const std::string& path) {
  const auto place = place_of(c, path);
  return std::visit([](const auto& value) -> py::object { return py::cast(value); }, place.key->get(c, place.name));
}

std::string help(const Case& c, const std::string& path) {
  return cases::meaning(*place_of(c, path).key, c);
}

}  // namespace

void bind_case(py::module_& module) {
  py::class_<Case>(module, "Case")
      .def(py::init<>())
      .def(py::init<const Case&>())
      .def_readwrite("name", &Case::name)
      .def("paths", &paths_in)
      .def("get", &get)
      .def("help", &help)
      .def("changed",
           [](const Case& c, const std::vector<std::string>& assignments) {
             return cases::changed(c, assignments, c.name);
           })
      .def("to_toml", &cases::resolved_text)
      .def("hash", [](const Case& c) { return cases::case_hash(c, cases::Step::kTest); });
  module.def("read_case", &cases::read_case, py::arg("file"), py::arg("overrides") = std::vector<std::string>());
  module.def("case_from_text", &cases::case_from_text, py::arg("text"), py::arg("source") = "case",
             py::arg("overrides") = std::vector<std::string>());
  module.def("ready_case", [](const std::string& name) {
    auto c = cases::ready_case(name);
    c.name = name;
    return c;
  });
  module.def("ready_cases", &cases::ready_cases);
  module.def("ready_case_title", &cases::ready_case_title);
}

}  // namespace strandlab::python
