// Virtual tests into a run folder.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>

#include "strandlab/core/error.hpp"
#include "strandlab/glue/glue.hpp"
#include "strandlab/io/vtk.hpp"
#include "strandlab/report/plots.hpp"
#include "strandlab/report/theory_curves.hpp"
#include "strandlab/run/record.hpp"
#include "strandlab/run/steps.hpp"
#include "strandlab/run/theory_rows.hpp"

namespace strandlab::run {
namespace {

namespace fs = std::filesystem;
using cases::Step;

void write_moduli(const Journey& journey, const Tested& tested) {
  report::moduli_table(moduli_of(journey.formed, tested)).write(journey.folder.file("moduli.csv"));
}

// The numbers of the closed-form models; modulus against glue and against compaction for each test, with these models
// over them.
void write_theory_and_plots(Journey& journey, const std::vector<report::PanelModulus>& moduli) {
  const auto& c = journey.formed.c;
  const auto theory = report::theory_moduli(theory_rows(c, journey.formed.mat), moduli, c.off_axis);
  report::theory_table(theory).write(journey.folder.file("theory.csv"));
  const auto name = [&c](double compliance_t) { return cases::name_of_glue(c, compliance_t); };
  if (!c.pictures) return;
  const auto plots = journey.folder.file("plots");
  fs::create_directories(plots);
  std::vector<report::Picture> pictures;
  for (const auto kind : c.test.kinds) {
    const std::string test = vtest::name(kind);
    pictures.push_back({report::compliance_plot(moduli, test, report::theory_against_compliance(theory, test)),
                        plots / (test + "_against_compliance.png")});
    pictures.push_back({report::compaction_plot(moduli, test, report::theory_against_compaction(theory, test), name),
                        plots / (test + "_against_compaction.png")});
  }
  draw_plots(journey, Step::kTest, pictures);
}

// Tables and plots that are missing of finished tests follow from the record.
void restore_tables(Journey& journey, const Tested& tested) {
  auto& folder = journey.folder;
  const auto missing = folder.missing(Step::kTest, journey.formed.c);
  if (missing.empty()) return;
  journey.log.say(fmt::format("test: made again, as missing: {}", fmt::join(missing, ", ")));
  folder.forget(Step::kPage);
  write_moduli(journey, tested);
  write_theory_and_plots(journey, moduli_of(journey.formed, tested));
  folder.save();
}

// Where the panel is glued, and how far its glue lines slide where the tension test told it.
std::vector<io::GlueLinePoint> glue_lines_of(const Panel<2>& panel, const TestedState& state,
                                             const glue::CuringOptions& curing) {
  std::vector<io::GlueLinePoint> points;
  for (const auto& slip : state.result.slips)
    points.push_back({static_cast<int>(slip.a), static_cast<int>(slip.b), slip.position, slip.slip_mm_per_strain});
  if (!points.empty()) return points;
  for (const auto& p : glue::cure(panel, curing))
    points.push_back({p.a.strand, p.b.strand, (p.a.position + p.b.position) / 2, std::nan("")});
  return points;
}

void write_glue_lines(Journey& journey, const Panel<2>& panel, const Tested& tested) {
  const auto& folder = journey.folder;
  const auto file = folder.glue_line_file(tested.back().compaction);
  fs::create_directories(file.parent_path());
  io::write_glue_vtu(glue_lines_of(panel, tested.back(), journey.formed.c.test.curing), file);
  std::vector<io::PvdEntry> states;
  for (const auto& state : tested)
    states.push_back({state.compaction, folder.glue_line_file(state.compaction).filename().string()});
  io::write_pvd(states, file.parent_path() / "glue_lines.pvd");
}

// The state's files and its place in the record: tests that are stopped go on behind it.
void keep(Journey& journey, const Tested& tested) {
  auto& folder = journey.folder;
  const auto& last = tested.back();
  if (!last.result.slips.empty()) {
    const auto file = folder.slip_file(last.compaction);
    fs::create_directories(file.parent_path());
    report::slip_table(last.result).write(file);
  }
  folder.record(Step::kTest)["states"] = run::to_json(tested);
  write_moduli(journey, tested);
  folder.save();
}

}  // namespace

Tested tested_in(Journey& journey) {
  auto& states = journey.folder.record(Step::kTest)["states"];
  if (states.is_null()) states = nlohmann::json::array();
  try {
    return tested_from_json(states);
  } catch (const nlohmann::json::exception& e) {
    throw InputError(
        fmt::format("{}: not the record of a strandlab run's tests ({}); test again with strandlab test "
                    "--force",
                    journey.folder.file("run.json").string(), e.what()));
  }
}

Tested test_into(Journey& journey) {
  auto& folder = journey.folder;
  const auto& c = journey.formed.c;
  if (folder.finished(Step::kTest)) {
    auto tested = tested_in(journey);
    restore_tables(journey, tested);
    journey.log.say(fmt::format("test: already done, {}", folder.file("moduli.csv").string()));
    return tested;
  }
  const auto panels = read_panels(journey);
  journey.log.open(folder.file("log.txt"));
  folder.forget(Step::kPage);
  auto tested = tested_in(journey);
  for (auto i = tested.size(); i < panels.size(); ++i) {
    tell_progress(c, i, journey.log);
    tested.push_back(test(c, panels[i], c.schedule.compactions[i], journey.log));
    write_glue_lines(journey, panels[i], tested);
    keep(journey, tested);
  }
  double wall_s = 0;
  for (const auto& state : tested) wall_s += state.wall_s;
  folder.record(Step::kTest)["wall_s"] = wall_s;
  refuse_if_none_is_testable(tested);
  const auto moduli = moduli_of(journey.formed, tested);
  write_theory_and_plots(journey, moduli);
  folder.record(Step::kTest)["findings"] = report::to_json(findings_of(journey.formed, tested));
  folder.set_finished(Step::kTest);
  journey.log.say(fmt::format("test: {} moduli -> {}", moduli.size(), folder.file("moduli.csv").string()));
  return tested;
}

}  // namespace strandlab::run
