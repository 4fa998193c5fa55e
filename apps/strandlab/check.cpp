// strandlab check: the resolved case and what it will cost, before anything runs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "case_arguments.hpp"
#include "commands.hpp"
#include "strandlab/case/estimate.hpp"
#include "strandlab/case/write.hpp"
#include "strandlab/run/composition.hpp"
#include "strandlab/run/duration.hpp"
#include "strandlab/run/form.hpp"
#include "terminal.hpp"

namespace strandlab::app {
namespace {

// As comments, so that the output is a case file again.
void check(const CaseArguments& arguments) {
  const auto formed = run::form(arguments.read());
  run::refuse_untestable(formed);
  const auto& c = formed.c;
  const auto& mat = formed.mat;
  const auto e = cases::estimate(c, formed.panel);
  print("{}\n", cases::resolved_text(c));
  print("# mat: {} rows, {} strands, {:g} x {:g} mm\n", mat.layers.size(), e.strands, mat.length_mm,
        mat.thickness_mm());
  if (!c.mat_file.empty()) {
    print(
        "# from mat.file: the sizes and rows of this mat count, not mat.length_mm, mat.layer_thickness_mm, "
        "mat.rows\n");
  }
  if (const auto remark = run::remark_on_length(formed)) print("# {}\n", *remark);
  for (const auto& line : run::composition(cases::weigh(c, mat))) print("# {}\n", line);
  for (const auto& line : cases::derived_constants(c)) print("# {}\n", line);
  print("# as formed: {:.1f} kg/m3\n", cases::density_kg_m3(c, mat, 0));
  for (const auto& state : run::kept_states(formed))
    print("# kept at compaction {}: {:.2f} mm, {:.1f} kg/m3\n", state.compaction, state.thickness_mm,
          state.density_kg_m3);
  print("# particles: {}\n# cells: {} of {:.4g} x {:.4g} mm\n", e.particles, e.cells, e.cell_length_mm,
        e.cell_height_mm);
  print("# steps: {:.0f} of {:.3g} s, {:.3g} ms of pressing\n", e.steps, e.time_step_s, 1e3 * e.pressing_time_s);
  print("# memory: {:.0f} MB\n# disk: {:.0f} MB\n", e.memory_bytes / 1e6, e.disk_bytes / 1e6);
  print("# estimated run time on {} thread(s): {} pressing, {} tests\n", cases::thread_count(c),
        run::duration(e.press_s), run::duration(e.test_s));
}

}  // namespace

void add_check(CLI::App& app) {
  auto arguments = std::make_shared<CaseArguments>();
  auto* command =
      app.add_subcommand("check", "check a case; print it resolved, with particles, steps, memory and run time");
  add_case_arguments(*command, *arguments);
  command->callback([arguments] { check(*arguments); });
}

}  // namespace strandlab::app
