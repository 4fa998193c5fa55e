// strandlab press: presses the mat of a case through its compactions.
#include "strandlab/press/press.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "commands.hpp"
#include "duration.hpp"
#include "journey.hpp"
#include "profile_bins.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/io/case_estimate.hpp"
#include "strandlab/io/checkpoint.hpp"
#include "strandlab/io/vtk.hpp"
#include "strandlab/report/density_profiles.hpp"
#include "strandlab/report/findings.hpp"
#include "strandlab/report/frames.hpp"
#include "strandlab/report/morphology.hpp"
#include "strandlab/report/plots.hpp"
#include "strandlab/report/result_tables.hpp"
#include "strandlab/report/section_picture.hpp"

namespace strandlab::app {
namespace {

namespace fs = std::filesystem;

std::string progress_line(const press::Progress& p) {
  const double percent = p.target > 0 ? 100 * p.compaction / p.target : 100;
  return fmt::format("press  {:3.0f} %  compaction {:.3f} of {:g}  step {}  {:.1f} M particle-steps/s  {} left",
                     percent, p.compaction, p.target, p.step, 1e-6 * p.particle_steps_per_s, duration(p.eta_s));
}

// Files of the panel at each compaction and the checkpoints to go on from.
press::Sink<2> make_sink(const Journey& journey, const io::CheckpointStore& store, Console& console) {
  const auto hash = io::case_hash(journey.c, io::Step::kPress);
  const auto& folder = journey.folder;
  const auto compactions = journey.c.schedule.compactions;
  press::Sink<2> sink;
  sink.snapshot = [&folder, &console, compactions, hash](const Panel<2>& panel, int index) {
    const double compaction = compactions[static_cast<std::size_t>(index)];
    io::write_panel(panel, hash, folder.panel_file(compaction));
    io::write_vtu(panel, folder.paraview_file(compaction));
    console.say(fmt::format("press: panel at compaction {} kept", compaction));
  };
  sink.frames = report::kFrames;
  sink.frame = [&folder, hash](const Panel<2>& panel, int index) {
    io::write_panel(report::frame_of(panel), hash, folder.frame_file(index));
  };
  sink.checkpoint = [&folder, &store](const press::Checkpoint<2>& checkpoint) {
    report::press_table(checkpoint.records).write(folder.file("press.csv"));
    store.save(checkpoint);
  };
  sink.progress = [&console](const press::Progress& p) { console.progress(progress_line(p)); };
  sink.checkpoint_interval_s = journey.c.checkpoint_interval_s;
  return sink;
}

// Nanoseconds of one thread per particle-step, by phase.
nlohmann::json phases(const mpm::Timing& t, double particle_steps) {
  const auto ns = [particle_steps](double seconds) { return particle_steps > 0 ? 1e9 * seconds / particle_steps : 0; };
  return {{"weights", ns(t.weights)}, {"surface", ns(t.surface)}, {"scatter", ns(t.scatter)},  {"grid", ns(t.grid)},
          {"contact", ns(t.contact)}, {"gather", ns(t.gather)},   {"material", ns(t.material)}};
}

nlohmann::json summary(const press::Outcome<2>& outcome, std::size_t particles, int threads) {
  const double particle_steps = outcome.particle_steps_per_s * outcome.wall_s;
  return {{"particles", particles},
          {"steps", outcome.steps},
          {"threads", threads},
          {"wall_s", outcome.wall_s},
          {"particle_steps_per_s", outcome.particle_steps_per_s},
          {"ns_per_particle_step", outcome.particle_steps_per_s > 0 ? 1e9 / outcome.particle_steps_per_s : 0},
          {"ns_per_particle_step_by_phase", phases(outcome.timing, particle_steps)},
          {"fields_per_node", outcome.timing.fields_per_node},
          {"plastic_fraction", outcome.timing.plastic_fraction},
          {"engine_bytes", outcome.bytes},
          {"warnings", outcome.warnings}};
}

std::vector<Panel<2>> read_panels(const Journey& journey) {
  const auto hash = io::case_hash(journey.c, io::Step::kPress);
  std::vector<Panel<2>> panels;
  for (const double compaction : journey.c.schedule.compactions) {
    panels.push_back(io::read_panel<2>(journey.folder.panel_file(compaction), hash));
  }
  return panels;
}

void draw_pictures(const Journey& journey, const std::vector<Panel<2>>& panels) {
  std::vector<const Panel<2>*> all;
  all.reserve(panels.size());
  for (const auto& panel : panels) all.push_back(&panel);
  for (const auto& [colouring, name] :
       {std::pair{report::Colouring::kGrainAngle, "grain_angle"}, std::pair{report::Colouring::kDensity, "density"}}) {
    report::PictureOptions options;
    options.colouring = colouring;
    options.range = report::common_range(all, colouring);
    for (std::size_t i = 0; i < panels.size(); ++i) {
      report::draw_section(panels[i], options, journey.folder.picture_file(name, journey.c.schedule.compactions[i]));
    }
  }
}

void warn_if(Console& console, const report::Warning& warning) {
  if (warning) console.warn(*warning);
}

// What run.json keeps of the density profiles.
nlohmann::json profile_summaries(const std::vector<profile::Profile>& profiles) {
  auto list = nlohmann::json::array();
  for (const auto& p : profiles) {
    const auto s = profile::summarise(p);
    list.push_back({{"compaction", p.compaction},
                    {"mean_kg_m3", s.mean},
                    {"peak_kg_m3", s.peak},
                    {"peak_depth_mm", s.peak_depth_mm},
                    {"skin_kg_m3", s.skin},
                    {"surface_kg_m3", s.surface},
                    {"core_kg_m3", s.core},
                    {"surface_over_core", s.surface_over_core()}});
  }
  return list;
}

void write_profiles(Journey& journey, const std::vector<Panel<2>>& panels, Console& console) {
  auto& folder = journey.folder;
  std::vector<profile::Profile> profiles;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const double compaction = journey.c.schedule.compactions[i];
    profiles.push_back(profile::density_profile(panels[i], bins_of_one_cell(journey.c, panels[i], compaction)));
    profiles.back().compaction = compaction;  // as in the other tables; the panel is one time step beyond
  }
  report::profile_table(profiles).write(folder.file("profile.csv"));
  report::profile_summary_table(profiles).write(folder.file("profile_summary.csv"));
  warn_if(console, report::plot_density_profiles(profiles, folder.file("pictures") / "density_profile.png"));
  folder.record(io::Step::kPress)["density_profiles"] = profile_summaries(profiles);
}

// Everything that follows from the panels and the records of the pressing; without records, what follows from the
// panels.
void write_report(Journey& journey, const std::vector<press::Record>& records, const std::vector<std::string>& warnings,
                  Console& console) {
  const auto& folder = journey.folder;
  const auto panels = read_panels(journey);
  std::vector<io::PvdEntry> states;
  std::vector<report::Morphology> shapes;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const double compaction = journey.c.schedule.compactions[i];
    states.push_back({compaction, folder.paraview_file(compaction).filename().string()});
    shapes.push_back(report::morphology(panels[i], compaction));
  }
  io::write_pvd(states, folder.file("paraview") / "panel.pvd");
  report::morphology_table(shapes).write(folder.file("morphology.csv"));
  report::histogram_table(shapes).write(folder.file("histograms.csv"));
  write_profiles(journey, panels, console);
  draw_pictures(journey, panels);
  if (!records.empty()) {
    auto findings = report::pressing_findings(records, press::judged_from(journey.c.schedule), warnings);
    for (const auto& more : {report::softening_findings(io::strand_kinds(journey.c)), report::shape_findings(shapes)})
      findings.insert(findings.end(), more.begin(), more.end());
    journey.folder.record(io::Step::kPress)["findings"] = report::to_json(findings);
    warn_if(console, report::plot_stress(records, folder.file("pictures") / "stress.png"));
  }
  warn_if(console, report::plot_grain_angles(shapes, folder.file("pictures") / "grain_angles.png"));
  warn_if(console, report::plot_thickness_strains(shapes, folder.file("pictures") / "thickness_strains.png"));
}

mpm::Options engine_options(const io::Case& c) {
  auto options = c.mpm;
  options.threads = io::thread_count(c);
  options.profile = true;
  return options;
}

void make_folders(const io::RunFolder& folder) {
  for (const auto* name : {"panels", "frames", "paraview", "pictures"}) fs::create_directories(folder.file(name));
}

// The records of a finished pressing, from its last checkpoint; none where it has gone.
std::vector<press::Record> last_records(const Journey& journey) {
  const io::CheckpointStore store(journey.folder.path(), io::case_hash(journey.c, io::Step::kPress));
  const auto last = store.load<2>(nullptr);
  const bool complete = last && last->snapshots_done == static_cast<int>(journey.c.schedule.compactions.size());
  return complete ? last->records : std::vector<press::Record>{};
}

// Tables that are missing of a finished pressing follow from its panels, press.csv from its last checkpoint.
void restore_tables(Journey& journey, Console& console) {
  auto& folder = journey.folder;
  const auto missing = folder.missing(io::Step::kPress, journey.c);
  if (missing.empty()) return;
  refuse_missing_panels(journey);
  std::vector<press::Record> records;
  if (!fs::exists(folder.file("press.csv"))) {
    records = last_records(journey);
    if (records.empty()) {
      throw InputError(
          fmt::format("{}: missing: press.csv, and the checkpoint of the end of the pressing that has its numbers: put "
                      "one back, or press again with strandlab press --force",
                      folder.path().string()));
    }
  }
  console.say(fmt::format("press: made again, as missing: {}", fmt::join(missing, ", ")));
  folder.forget(io::Step::kPage);
  make_folders(folder);
  if (!records.empty()) report::press_table(records).write(folder.file("press.csv"));
  write_report(journey, records, folder.record(io::Step::kPress).value("warnings", std::vector<std::string>{}),
               console);
  folder.save();
}

void press_alone(const CaseArguments& arguments) {
  travel(arguments, io::Step::kPress, io::Step::kPress, [](Journey& journey, Console& console) {
    do_mat(journey, console);
    do_press(journey, console);
  });
}

}  // namespace

void do_press(Journey& journey, Console& console) {
  auto& folder = journey.folder;
  if (folder.finished(io::Step::kPress)) {
    restore_tables(journey, console);
    console.say(fmt::format("press: already done in {}", folder.path().string()));
    return;
  }
  const io::CheckpointStore store(folder.path(), io::case_hash(journey.c, io::Step::kPress));
  std::vector<std::string> warnings;
  const auto resume = store.load<2>(&warnings);
  console.log_to(folder.file("log.txt"));
  for (const auto& warning : warnings) console.warn(warning);
  for (const auto& line : io::derived_constants(journey.c)) console.say(line);
  if (journey.c.hotpress.given)
    console.warn("the case has [hotpress], but this pressing is cold; strandlab hotpress presses its mat hot");
  const int threads = io::thread_count(journey.c);
  const auto particles = io::estimate(journey.c, journey.panel).particles;
  console.say(resume ? fmt::format("press: going on from compaction {:.4f}", resume->panel.compaction())
                     : fmt::format("press: {} particles on {} thread(s)", particles, threads));
  folder.record(io::Step::kPress)["started"] = true;
  folder.forget(io::Step::kPage);
  make_folders(folder);

  const auto setup = press::setup(journey.panel, journey.c.grid, journey.c.sides, engine_options(journey.c));
  const auto outcome =
      press::press(journey.panel, journey.c.schedule, setup, make_sink(journey, store, console), resume);
  for (const auto& warning : outcome.warnings) console.warn(warning);
  report::press_table(outcome.records).write(folder.file("press.csv"));
  write_report(journey, outcome.records, outcome.warnings, console);
  folder.record(io::Step::kPress).update(summary(outcome, particles, threads));
  folder.set_finished(io::Step::kPress);
  console.say(fmt::format("press: {} steps in {}, {:.1f} M particle-steps/s -> {}", outcome.steps,
                          duration(outcome.wall_s), 1e-6 * outcome.particle_steps_per_s,
                          folder.file("press.csv").string()));
}

void add_press(CLI::App& app) {
  auto arguments = std::make_shared<CaseArguments>();
  auto* command = app.add_subcommand("press", "press the mat of a case: press.csv, panels, pictures");
  add_case_arguments(*command, *arguments);
  add_folder_arguments(*command, *arguments);
  command->callback([arguments] { press_alone(*arguments); });
}

}  // namespace strandlab::app
