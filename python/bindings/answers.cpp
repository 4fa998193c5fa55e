// What needs no pressing of material points: glue lines, the hot press as a column, closed forms, lap-shear tables.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <string>
#include <utility>

#include "bindings.hpp"
#include "observer.hpp"
#include "strandlab/bondline/analysis.hpp"
#include "strandlab/bondline/example.hpp"
#include "strandlab/case/case.hpp"
#include "strandlab/files/json_text.hpp"
#include "strandlab/glue/glue.hpp"
#include "strandlab/report/bondline_tables.hpp"
#include "strandlab/report/estimates.hpp"
#include "strandlab/report/hotpress_results.hpp"
#include "strandlab/run/hotpress.hpp"
#include "strandlab/run/theory_rows.hpp"
#include "strandlab/theory/estimate.hpp"

namespace strandlab::python {
namespace {

py::dict cure(const cases::Case& c, const Panel<2>& panel) {
  files::CsvTable table({"strand_a", "strand_b", "x_mm", "y_mm", "length_mm", "gap_mm"});
  for (const auto& point : without_lock([&] { return glue::cure(panel, c.test.curing); })) {
    const Vec<2> middle = 0.5 * (point.a.position + point.b.position);
    table.add_row({static_cast<long long>(point.a.strand), static_cast<long long>(point.b.strand), middle[0], middle[1],
                   point.area, point.gap});
  }
  return columns_of(table);
}

py::dict theory_of(const cases::Case& c) {
  theory::Question question;
  question.off_axis = c.off_axis;
  return columns_of(without_lock(
      [&] { return report::estimate_table(theory::estimate(run::theory_question(c, std::move(question), {}, {}))); }));
}

py::dict hot_press(const cases::Case& c, py::object on_progress) {
  PythonObserver observer(std::move(on_progress));
  const auto pressed = without_lock([&] { return run::hotpress(c, observer); });
  py::dict answer;
  answer["record"] = columns_of(report::hotpress_table(pressed.band.cycle));
  answer["profiles"] = columns_of(report::profiles_table(pressed.band.cycle));
  answer["answers"] = py::module_::import("json").attr("loads")(report::to_json(pressed.band).dump());
  answer["summary"] = report::summary(pressed.band);
  answer["notes"] = pressed.notes;
  return answer;
}

py::dict bond_lines(const std::filesystem::path& file, const std::vector<std::string>& group_by,
                    const std::vector<std::string>& within) {
  bondline::Options options;
  options.group_by = group_by;
  options.within = within;
  const auto analysis = without_lock([&] { return bondline::analyse(bondline::read_specimens(file), options); });
  py::dict answer;
  answer["specimens"] = columns_of(report::specimen_table(analysis));
  answer["groups"] = columns_of(report::group_table(analysis));
  answer["comparisons"] = columns_of(report::comparison_table(analysis));
  answer["text"] = report::text_of(analysis);
  answer["json"] = bondline::to_json(analysis, file.filename().string());
  return answer;
}

}  // namespace

void bind_answers(py::module_& module) {
  module.def("cure", &cure, py::arg("case"), py::arg("panel"));
  module.def("theory", &theory_of, py::arg("case"));
  module.def("hotpress", &hot_press, py::arg("case"), py::arg("on_progress"));
  module.def("bondline_example", &bondline::example_table, py::arg("seed"));
  module.def("bondline", &bond_lines, py::arg("file"), py::arg("group_by"), py::arg("within"));
}

}  // namespace strandlab::python
