#include "strandlab/run/plate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <utility>

#include "strandlab/case/estimate.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/free_memory.hpp"
#include "strandlab/core/stopwatch.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/files/text_file.hpp"
#include "strandlab/io/checkpoint.hpp"
#include "strandlab/io/vtk.hpp"
#include "strandlab/panel/mirrored.hpp"
#include "strandlab/report/density_profiles.hpp"
#include "strandlab/report/horizontal_density.hpp"
#include "strandlab/run/composition.hpp"
#include "strandlab/run/duration.hpp"
#include "strandlab/run/log.hpp"
#include "strandlab/run/press.hpp"
#include "strandlab/run/press_hot.hpp"
#include "strandlab/run/record.hpp"
#include "strandlab/statics/cholesky.hpp"

namespace strandlab::run {
namespace {

namespace fs = std::filesystem;
using cases::Step;

void refuse_too_large(const vtest::PlateSize& size) {
  const double free_GB = 1e-9 * free_memory_bytes();
  if (size.memory_GB <= free_GB) return;
  throw InputError(
      fmt::format("the tests of this plate have {} unknowns and need about {:.1f} GB of memory, {:.1f} GB are free; "
                  "take larger elements (test.element_length_mm, test.elements_through_strand)",
                  size.unknowns, size.memory_GB, free_GB));
}

void refuse_too_large(const cases::PlatePressSize& size) {
  const double free = free_memory_bytes();
  if (size.memory_bytes <= free) return;
  throw InputError(
      fmt::format("pressing this plate takes {:.3g} particles and about {:.1f} GB of memory, {:.1f} GB are free; take "
                  "longer cells (grid.cell_aspect), fewer (grid.cells_through_strand) or a smaller window",
                  static_cast<double>(size.particles), 1e-9 * size.memory_bytes, 1e-9 * free));
}

void tell(const vtest::PlateResult& result, Observer& observer) {
  for (const auto& warning : result.warnings) observer.warn(warning);
  if (result.floating_strands > 0) {
    observer.say(
        fmt::format("test: {} of {} strands are not part of the largest piece that glue holds together and are "
                    "left out",
                    result.floating_strands, result.strands));
  }
  for (const auto& m : result.moduli)
    observer.say(fmt::format("test: {}, 1/D_t = {}: {:.4g} MPa", m.test, m.compliance_t_mm_per_MPa, m.modulus_MPa));
}

// What flows between the steps of a plate through a run folder.
struct PlateJourney {
  FormedPlate formed;
  RunFolder folder;
  Log log;
  std::string hash() const { return cases::case_hash(formed.c, Step::kPress); }
};

// As it is kept and tested: of half a mat with its mirror image, where the case says so.
Panel<3> whole_of(const FormedPlate& formed, const Panel<3>& pressed) {
  return formed.c.half == cases::PressedHalf::kMirrored ? with_mirror_image(pressed) : pressed;
}

// Before the press closes: what its tests could not use, or would not have the memory for.
void refuse_untestable(const FormedPlate& formed) {
  const auto options = cases::plate_options(formed.c);
  const auto mat = whole_of(formed, formed.panel);
  vtest::check(mat, options);
  refuse_too_large(vtest::size_of_tests(mat, options));
}

void form_into(PlateJourney& journey) {
  auto& [formed, folder, log] = journey;
  const auto file = folder.file("mat.json");
  const auto text = mat::to_text(formed.mat);
  if (folder.finished(Step::kMat) && fs::exists(file)) {
    if (files::read_text(file) == text) return;
    throw InputError(
        fmt::format("{}: not the mat of this case (changed by hand, or the mat file has changed since); "
                    "choose another run folder with -o, or --force",
                    file.string()));
  }
  folder.forget(Step::kMat);
  files::write_atomically(file, text);
  folder.set_finished(Step::kMat);
  log.say(fmt::format("mat: {} layers, {} strands, {:g} x {:g} mm -> {}", formed.mat.layers.size(),
                      formed.panel.strands.size(), formed.mat.length_mm, formed.mat.width_mm, file.string()));
  for (const auto& line : composition(cases::weigh(formed.c, formed.mat))) log.say("mat: " + line);
}

// Files of the panel at each compaction and the checkpoints to go on from.
press::Sink<3> keep_in(PlateJourney& journey, const io::CheckpointStore& store) {
  press::Sink<3> sink;
  sink.snapshot = [&journey, hash = journey.hash()](const Panel<3>& pressed, int index) {
    const auto panel = whole_of(journey.formed, pressed);
    const double compaction = journey.formed.c.schedule.compactions[static_cast<std::size_t>(index)];
    io::write_panel(panel, hash, journey.folder.panel_file(compaction));
    io::write_vtu(panel, journey.folder.paraview_file(compaction));
    journey.log.say(fmt::format("press: panel at compaction {} kept", compaction));
  };
  sink.checkpoint = [&folder = journey.folder, &store](const press::Checkpoint<3>& checkpoint) {
    report::press_table(checkpoint.records).write(folder.file("press.csv"));
    store.save(checkpoint);
  };
  sink.checkpoint_interval_s = journey.formed.c.checkpoint_interval_s;
  return sink;
}

Panel<3> read_panel(const PlateJourney& journey, double compaction) {
  return io::read_panel<3>(journey.folder.panel_file(compaction), journey.hash());
}

// Density through the thickness, in bins as high as a cell of the press at the start, and over the area.
void write_densities(PlateJourney& journey) {
  const auto& [formed, folder, log] = journey;
  std::vector<profile::Profile> profiles;
  std::vector<report::HorizontalDensity> over_area;
  for (const double compaction : formed.c.schedule.compactions) {
    const auto panel = read_panel(journey, compaction);
    profiles.push_back(profile::density_profile(
        panel, divisions(panel.thickness_mm(), thinnest_strand(panel) / formed.c.grid.cells_through_strand)));
    profiles.back().compaction = compaction;
    over_area.push_back(report::horizontal_density(panel, compaction));
  }
  report::profile_table(profiles).write(folder.file("profile.csv"));
  report::profile_summary_table(profiles).write(folder.file("profile_summary.csv"));
  report::density_map_table(over_area).write(folder.file("density_map.csv"));
  report::horizontal_density_table(over_area).write(folder.file("horizontal_density.csv"));
}

bool has_panels(const PlateJourney& journey) {
  const auto& compactions = journey.formed.c.schedule.compactions;
  return journey.folder.finished(Step::kPress) &&
         std::all_of(compactions.begin(), compactions.end(),
                     [&](double compaction) { return fs::exists(journey.folder.panel_file(compaction)); });
}

void press_into(PlateJourney& journey) {
  auto& [formed, folder, log] = journey;
  if (has_panels(journey)) return;
  folder.forget(Step::kTest);
  for (const auto* name : {"panels", "paraview"}) fs::create_directories(folder.file(name));
  const io::CheckpointStore store(folder.path(), journey.hash());
  std::vector<std::string> warnings;
  const auto resume = store.load<3>(&warnings);
  for (const auto& warning : warnings) log.warn(warning);
  if (resume) log.say(fmt::format("press: going on from compaction {:.4f}", resume->panel.compaction()));
  folder.record(Step::kPress)["started"] = true;
  const auto outcome = press_plate(formed, keep_in(journey, store), resume, log);
  report::press_table(outcome.records).write(folder.file("press.csv"));
  std::vector<io::PvdEntry> states;
  for (const double compaction : formed.c.schedule.compactions)
    states.push_back({compaction, folder.paraview_file(compaction).filename().string()});
  io::write_pvd(states, folder.file("paraview") / "panel.pvd");
  write_densities(journey);
  folder.record(Step::kPress).update(summary(outcome, cases::thread_count(formed.c)));
  folder.set_finished(Step::kPress);
  log.say(fmt::format("press: {} steps in {}, {:.1f} M particle-steps/s, at most {} fields at a node -> {}",
                      outcome.steps, duration(outcome.wall_s), 1e-6 * outcome.particle_steps_per_s, outcome.most_fields,
                      folder.file("press.csv").string()));
}

void write_results(PlateJourney& journey, const TestedPlate& tested) {
  auto& [formed, folder, log] = journey;
  const auto moduli = moduli_of(formed, tested);
  report::moduli_table(moduli).write(folder.file("moduli.csv"));
  std::vector<report::PlateState> states;
  for (const auto& state : tested) states.push_back({state.compaction, state.result});
  if (formed.panel.periodic) report::plate_table(states).write(folder.file("abd.csv"));
  folder.record(Step::kTest)["states"] = run::to_json(tested);
  folder.set_finished(Step::kTest);
  log.say(fmt::format("test: {} moduli -> {}", moduli.size(), folder.file("moduli.csv").string()));
}

bool is_tested(const PlateJourney& journey) {
  const auto& folder = journey.folder;
  return folder.finished(Step::kTest) && fs::exists(folder.file("moduli.csv")) &&
         (!journey.formed.panel.periodic || fs::exists(folder.file("abd.csv")));
}

void test_into(PlateJourney& journey) {
  const auto& formed = journey.formed;
  TestedPlate tested;
  for (const double compaction : formed.c.schedule.compactions) {
    const auto panel = cases::is_pressed(formed.c) ? read_panel(journey, compaction) : whole_of(formed, formed.panel);
    tested.push_back(test_plate(formed, panel, compaction, journey.log));
  }
  if (std::all_of(tested.begin(), tested.end(), [](const auto& state) { return !state.not_testable.empty(); }))
    throw InputError(tested.front().not_testable);
  write_results(journey, tested);
}

}  // namespace

FormedPlate form_plate(cases::Case c) {
  auto mat = cases::make_plate_mat(c);
  cases::settle_states(c, mat);
  auto panel = cases::make_panel(c, mat);
  return {std::move(c), std::move(mat), std::move(panel)};
}

press::Outcome<3> press_plate(const FormedPlate& formed, press::Sink<3> keep,
                              const std::optional<press::Checkpoint<3>>& resume, Observer& observer) {
  const auto& c = formed.c;
  const auto size = cases::press_size(c, formed.panel);
  observer.say(fmt::format("press: {} particles on {} thread(s), about {:.0f} steps, {:.1f} GB of memory, {}",
                           size.particles, cases::thread_count(c), size.steps, 1e-9 * size.memory_bytes,
                           duration(size.press_s)));
  refuse_too_large(size);
  keep.progress = [&observer](const press::Progress& p) { observer.progress(progress_of(p)); };
  keep.cancelled = [&observer] { return observer.cancelled(); };
  auto schedule = c.schedule;
  schedule.half = c.half != cases::PressedHalf::kWhole;
  auto engine = engine_options(c);
  engine.smooth_bottom = schedule.half;
  const auto setup = press::setup(formed.panel, c.grid, cases::press_sides(c, formed.mat), engine);
  auto outcome = press::press(formed.panel, schedule, setup, keep, resume);
  for (const auto& warning : outcome.warnings) observer.warn(warning);
  return outcome;
}

TestedPlateState test_plate(const FormedPlate& formed, const Panel<3>& panel, double compaction, Observer& observer) {
  TestedPlateState state;
  state.compaction = compaction;
  const auto options = cases::plate_options(formed.c);
  const auto size = vtest::size_of_tests(panel, options);
  observer.say(fmt::format("test: compaction {}: {} unknowns, about {:.1f} GB of memory", compaction, size.unknowns,
                           size.memory_GB));
  refuse_too_large(size);
  try {
    const Stopwatch watch(state.wall_s);
    state.result = vtest::measure(panel, options, [&observer] { stop_if_cancelled(observer); });
  } catch (const statics::OutOfMemory&) {
    throw;  // nothing of the panel's: with more memory the run goes on from here
  } catch (const vtest::NotConnected& e) {
    state.not_testable = e.what();
  } catch (const RunError& e) {
    state.not_testable = e.what();
  }
  if (state.not_testable.empty())
    tell(state.result, observer);
  else
    observer.warn(fmt::format("compaction {}: this panel cannot be tested: {}", compaction, state.not_testable));
  return state;
}

std::vector<report::PanelModulus> moduli_of(const FormedPlate& formed, const TestedPlate& tested) {
  std::vector<report::PanelModulus> moduli;
  for (const auto& state : tested) {
    const double density = cases::density_kg_m3(formed.c, formed.mat, state.compaction);
    for (const auto& m : state.result.moduli) {
      moduli.push_back({state.compaction, m.test, m.compliance_t_mm_per_MPa, m.modulus_MPa, m.reaction_modulus_MPa,
                        std::nullopt, density});
    }
  }
  return moduli;
}

void plate(const cases::Case& c, const Place& place, Observer& observer, Step last) {
  auto formed = form_plate(c);
  if (last == Step::kTest) refuse_untestable(formed);
  const bool pressed = cases::is_pressed(formed.c);
  constexpr double kText = 1e6;  // bytes
  const double bytes = pressed ? cases::press_size(formed.c, formed.panel).disk_bytes : kText;
  RunFolder folder(place.folder, formed.c, Step::kMat, place.force, bytes);
  PlateJourney journey{std::move(formed), std::move(folder), Log(observer)};
  begin_record(journey.folder.record(), journey.formed);
  try {
    form_into(journey);
    if (last == Step::kMat) return;
    if (last == Step::kTest && is_tested(journey) && (!pressed || has_panels(journey))) {
      journey.log.say(fmt::format("{}: this run is finished; --force runs it again", journey.folder.path().string()));
      return;
    }
    journey.log.open(journey.folder.file("log.txt"));
    if (pressed) press_into(journey);
    if (last == Step::kTest) test_into(journey);
  } catch (const std::exception& e) {
    journey.log.keep_error(e.what());
    throw;
  }
}

}  // namespace strandlab::run
