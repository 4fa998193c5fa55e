// Pressing into a run folder.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "strandlab/case/estimate.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/io/checkpoint.hpp"
#include "strandlab/io/vtk.hpp"
#include "strandlab/report/board_findings.hpp"
#include "strandlab/report/density_profiles.hpp"
#include "strandlab/report/frames.hpp"
#include "strandlab/report/hotpress_results.hpp"
#include "strandlab/report/plots.hpp"
#include "strandlab/report/section_picture.hpp"
#include "strandlab/run/duration.hpp"
#include "strandlab/run/press.hpp"
#include "strandlab/run/record.hpp"
#include "strandlab/run/steps.hpp"

namespace strandlab::run {
namespace {

namespace fs = std::filesystem;
using cases::Step;

std::string press_hash(const Journey& journey) {
  return cases::case_hash(journey.formed.c, Step::kPress);
}

// Files of the panel at each compaction and the checkpoints to go on from.
press::Sink<2> keep_in(Journey& journey, const io::CheckpointStore& store) {
  const auto hash = press_hash(journey);
  const auto& c = journey.formed.c;
  std::map<std::string, std::string> material_of_kind;
  for (const auto& kind : c.kinds) material_of_kind[kind.name] = kind.material;
  press::Sink<2> sink;
  sink.snapshot = [&journey, hash, material_of_kind](const Panel<2>& panel, int index) {
    const auto& folder = journey.folder;
    const double compaction = journey.formed.c.schedule.compactions[static_cast<std::size_t>(index)];
    io::write_panel(panel, hash, folder.panel_file(compaction));
    io::write_annotated_vtu(panel, {&journey.formed.panel, material_of_kind}, folder.paraview_file(compaction));
    journey.log.say(fmt::format("press: panel at compaction {} kept", compaction));
  };
  sink.frames = report::kFrames;
  sink.frame = [&folder = journey.folder, hash](const Panel<2>& panel, int index) {
    io::write_panel(report::frame_of(panel), hash, folder.frame_file(index));
  };
  sink.checkpoint = [&folder = journey.folder, &store](const press::Checkpoint<2>& checkpoint) {
    report::press_table(checkpoint.records).write(folder.file("press.csv"));
    store.save(checkpoint);
  };
  sink.checkpoint_interval_s = c.checkpoint_interval_s;
  return sink;
}

void draw_pictures(Journey& journey, const std::vector<Panel<2>>& panels) {
  std::vector<const Panel<2>*> all;
  all.reserve(panels.size());
  for (const auto& panel : panels) all.push_back(&panel);
  for (const auto& [colouring, name] :
       {std::pair{report::Colouring::kGrainAngle, "grain_angle"}, std::pair{report::Colouring::kDensity, "density"}}) {
    report::PictureOptions options;
    options.colouring = colouring;
    options.range = report::common_range(all, colouring);
    for (std::size_t i = 0; i < panels.size(); ++i) {
      stop_if_cancelled(journey.log);
      const double compaction = journey.formed.c.schedule.compactions[i];
      report::draw_section(panels[i], options, journey.folder.picture_file(name, compaction));
    }
  }
}

void write_tables(Journey& journey, const Shapes& shapes) {
  const auto& folder = journey.folder;
  std::vector<io::PvdEntry> states;
  for (const double compaction : journey.formed.c.schedule.compactions)
    states.push_back({compaction, folder.paraview_file(compaction).filename().string()});
  io::write_pvd(states, folder.file("paraview") / "panel.pvd");
  report::morphology_table(shapes.morphologies).write(folder.file("morphology.csv"));
  report::histogram_table(shapes.morphologies).write(folder.file("histograms.csv"));
  report::profile_table(shapes.density_profiles).write(folder.file("profile.csv"));
  report::profile_summary_table(shapes.density_profiles).write(folder.file("profile_summary.csv"));
}

// Everything that follows from the panels and the records of the pressing; without records, what follows from the
// panels.
void write_what_follows(Journey& journey, const std::vector<press::Record>& records,
                        const std::vector<std::string>& warnings) {
  const auto pictures = journey.folder.file("pictures");
  const auto panels = read_panels(journey);
  const auto shapes = shapes_of(journey.formed.c, panels);
  auto& record = journey.folder.record(Step::kPress);
  record["density_profiles"] = run::to_json(shapes.density_profiles);
  if (!records.empty()) record["findings"] = report::to_json(findings_of(journey.formed.c, records, warnings, shapes));
  write_tables(journey, shapes);
  if (!journey.formed.c.pictures) return;
  fs::create_directories(pictures);
  draw_pictures(journey, panels);
  std::vector<report::Picture> plots{
      {report::profile_plot(shapes.density_profiles), pictures / "density_profile.png"},
      {report::grain_angle_plot(shapes.morphologies), pictures / "grain_angles.png"},
      {report::thickness_strain_plot(shapes.morphologies), pictures / "thickness_strains.png"}};
  if (!records.empty()) plots.push_back({report::stress_plot(records), pictures / "stress.png"});
  draw_plots(journey, Step::kPress, plots);
}

// What a hot press's cycle says, beside what its panel does.
void write_cycle(Journey& journey, const hotpress::Band& band) {
  auto& folder = journey.folder;
  report::write_hotpress_tables(band.cycle, folder.path());
  folder.record()["hotpress"] = report::to_json(band);
  for (const auto& line : report::summary(band)) journey.log.say(line);
}

void make_folders(const RunFolder& folder) {
  for (const auto* name : {"panels", "frames", "paraview"}) fs::create_directories(folder.file(name));
}

// Throws InputError, with the remedy, where a panel of the finished pressing is no longer there.
void refuse_missing_panels(const Journey& journey) {
  auto missing = journey.folder.missing(Step::kPress, journey.formed.c);
  std::erase_if(missing, [](const std::string& name) { return name.rfind("panels/", 0) != 0; });
  if (missing.empty()) return;
  throw InputError(fmt::format(
      "{}: missing: {}; only pressing again can make a panel: put it back, or press again with strandlab press --force",
      journey.folder.path().string(), fmt::join(missing, ", ")));
}

// The records of a finished pressing, from its last checkpoint; none where it has gone.
std::vector<press::Record> last_records(const Journey& journey) {
  const io::CheckpointStore store(journey.folder.path(), press_hash(journey));
  const auto last = store.load<2>(nullptr);
  const auto snapshots = static_cast<int>(journey.formed.c.schedule.compactions.size());
  return last && last->snapshots_done == snapshots ? last->records : std::vector<press::Record>{};
}

// Tables, pictures and plots that are missing of a finished pressing follow from its panels, press.csv and its plot
// from its last checkpoint.
void restore_tables(Journey& journey) {
  auto& folder = journey.folder;
  const auto missing = folder.missing(Step::kPress, journey.formed.c);
  if (missing.empty()) return;
  refuse_missing_panels(journey);
  const auto records = last_records(journey);
  if (records.empty() && !fs::exists(folder.file("press.csv"))) {
    throw InputError(
        fmt::format("{}: missing: press.csv, and the checkpoint of the end of the pressing that has its numbers: put "
                    "one back, or press again with strandlab press --force",
                    folder.path().string()));
  }
  journey.log.say(fmt::format("press: made again, as missing: {}", fmt::join(missing, ", ")));
  folder.forget(Step::kPage);
  make_folders(folder);
  if (!records.empty()) report::press_table(records).write(folder.file("press.csv"));
  write_what_follows(journey, records, folder.record(Step::kPress).value("warnings", std::vector<std::string>{}));
  folder.save();
}

// What a pressing begins with: where it starts from is told.
std::optional<press::Checkpoint<2>> begin(Journey& journey, const io::CheckpointStore& store) {
  const auto& c = journey.formed.c;
  auto& log = journey.log;
  std::vector<std::string> warnings;
  auto resume = store.load<2>(&warnings);
  log.open(journey.folder.file("log.txt"));
  for (const auto& warning : warnings) log.warn(warning);
  for (const auto& line : cases::derived_constants(c)) log.say(line);
  for (const auto& warning : remarks_on_widths(c)) log.warn(warning);
  if (c.hotpress.given && !cases::presses_hot(c)) {
    log.warn(fmt::format("hotpress.mechanics = \"{}\": this pressing is cold; strandlab hotpress presses its mat hot",
                         c.hotpress.mechanics));
  }
  const auto particles = cases::estimate(c, journey.formed.panel).particles;
  log.say(resume ? fmt::format("press: going on from compaction {:.4f}", resume->panel.compaction())
                 : fmt::format("press: {} particles on {} thread(s)", particles, cases::thread_count(c)));
  return resume;
}

}  // namespace

std::vector<Panel<2>> read_panels(const Journey& journey) {
  refuse_missing_panels(journey);
  const auto hash = press_hash(journey);
  std::vector<Panel<2>> panels;
  for (const double compaction : journey.formed.c.schedule.compactions) {
    panels.push_back(io::read_panel<2>(journey.folder.panel_file(compaction), hash));
  }
  return panels;
}

void press_into(Journey& journey) {
  auto& folder = journey.folder;
  if (folder.finished(Step::kPress)) {
    restore_tables(journey);
    journey.log.say(fmt::format("press: already done in {}", folder.path().string()));
    return;
  }
  const io::CheckpointStore store(folder.path(), press_hash(journey));
  const auto resume = begin(journey, store);
  folder.record(Step::kPress)["started"] = true;
  folder.forget(Step::kPage);
  make_folders(folder);
  const auto outcome = press(journey.formed, keep_in(journey, store), resume, journey.log);
  if (outcome.cycle) write_cycle(journey, *outcome.cycle);
  report::press_table(outcome.records).write(folder.file("press.csv"));
  write_what_follows(journey, outcome.records, outcome.warnings);
  folder.record(Step::kPress).update(summary(outcome, cases::thread_count(journey.formed.c)));
  folder.record(Step::kPress)["highest_stress_MPa"] = report::highest_stress_MPa(outcome.records);
  folder.set_finished(Step::kPress);
  journey.log.say(fmt::format("press: {} steps in {}, {:.1f} M particle-steps/s -> {}", outcome.steps,
                              duration(outcome.wall_s), 1e-6 * outcome.particle_steps_per_s,
                              folder.file("press.csv").string()));
}

}  // namespace strandlab::run
