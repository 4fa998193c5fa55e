#include "strandlab/run/check.hpp"

#include <fmt/format.h>

#include <utility>

#include "strandlab/case/estimate.hpp"
#include "strandlab/case/write.hpp"
#include "strandlab/run/composition.hpp"
#include "strandlab/run/duration.hpp"
#include "strandlab/run/form.hpp"
#include "strandlab/run/plate.hpp"

namespace strandlab::run {
namespace {

std::string checked_plate(cases::Case resolved) {
  const auto formed = form_plate(std::move(resolved));
  const auto& c = formed.c;
  const auto& mat = formed.mat;
  auto text = cases::resolved_text(c) + "\n";
  const auto add = [&text](const std::string& line) { text += "# " + line + "\n"; };
  add(fmt::format("mat: {} layers, {} strands, {:g} x {:g} x {:g} mm", mat.layers.size(), formed.panel.strands.size(),
                  mat.length_mm, mat.width_mm, mat.thickness_mm()));
  for (const auto& line : composition(cases::weigh(c, mat))) add(line);
  for (const auto& line : cases::derived_constants(c)) add(line);
  add(fmt::format("as formed: {:.1f} kg/m3", cases::density_kg_m3(c, mat, 0)));
  for (const double compaction : c.schedule.compactions)
    add(fmt::format("kept at compaction {}: {:.2f} mm, {:.1f} kg/m3", compaction, mat.thickness_mm() * (1 - compaction),
                    cases::density_kg_m3(c, mat, compaction)));
  double press_s = 0;
  if (cases::is_pressed(c)) {
    const auto size = cases::press_size(c, formed.panel);
    press_s = size.press_s;
    add(fmt::format("particles: {}", size.particles));
    add(fmt::format("steps: {:.0f}", size.steps));
    add(fmt::format("memory of the pressing: {:.0f} MB", size.memory_bytes / 1e6));
    add(fmt::format("disk: {:.0f} MB", size.disk_bytes / 1e6));
  }
  const auto tests = vtest::size_of_tests(formed.panel, cases::plate_options(c));
  add(fmt::format("tests: {} unknowns, {:.0f} MB", tests.unknowns, 1e3 * tests.memory_GB));
  const auto solutions = static_cast<double>(c.schedule.compactions.size() * c.test.compliance_t_mm_per_MPa.size());
  add(fmt::format("estimated run time on {} thread(s): {} pressing, {} tests", cases::thread_count(c),
                  duration(press_s), duration(solutions * tests.seconds_per_compliance)));
  return text;
}

}  // namespace

std::string checked_text(cases::Case resolved) {
  if (cases::has_plate_mat(resolved)) return checked_plate(std::move(resolved));
  const auto formed = form(std::move(resolved));
  refuse_untestable(formed);
  const auto& c = formed.c;
  const auto& mat = formed.mat;
  const auto e = cases::estimate(c, formed.panel);
  auto text = cases::resolved_text(c) + "\n";
  const auto add = [&text](const std::string& line) { text += "# " + line + "\n"; };
  add(fmt::format("mat: {} rows, {} strands, {:g} x {:g} mm", mat.layers.size(), e.strands, mat.length_mm,
                  mat.thickness_mm()));
  if (!c.mat_file.empty()) {
    add("from mat.file: the sizes and rows of this mat count, not mat.length_mm, mat.layer_thickness_mm, mat.rows");
  }
  if (const auto remark = remark_on_length(formed)) add(*remark);
  for (const auto& warning : remarks_on_widths(c)) add("warning: " + warning);
  for (const auto& line : composition(cases::weigh(c, mat))) add(line);
  if (const auto remark = remark_on_shares(c)) add(*remark);
  for (const auto& line : cases::derived_constants(c)) add(line);
  add(fmt::format("as formed: {:.1f} kg/m3", cases::density_kg_m3(c, mat, 0)));
  for (const auto& state : kept_states(formed))
    add(fmt::format("kept at compaction {}: {:.2f} mm, {:.1f} kg/m3", state.compaction, state.thickness_mm,
                    state.density_kg_m3));
  add(fmt::format("particles: {}", e.particles));
  add(fmt::format("cells: {} of {:.4g} x {:.4g} mm", e.cells, e.cell_length_mm, e.cell_height_mm));
  add(fmt::format("steps: {:.0f} of {:.3g} s, {:.3g} ms of pressing", e.steps, e.time_step_s, 1e3 * e.pressing_time_s));
  add(fmt::format("memory: {:.0f} MB", e.memory_bytes / 1e6));
  add(fmt::format("disk: {:.0f} MB", e.disk_bytes / 1e6));
  add(fmt::format("estimated run time on {} thread(s): {} pressing, {} tests", cases::thread_count(c),
                  duration(e.press_s), duration(e.test_s)));
  return text;
}

}  // namespace strandlab::run
