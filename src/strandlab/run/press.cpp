#include "strandlab/run/press.hpp"

#include <fmt/format.h>

#include <utility>

#include "strandlab/case/estimate.hpp"
#include "strandlab/report/board_findings.hpp"
#include "strandlab/run/duration.hpp"
#include "strandlab/run/press_hot.hpp"
#include "strandlab/run/profile_bins.hpp"

namespace strandlab::run {

Progress progress_of(const press::Progress& p) {
  return {"press", p.target > 0 ? p.compaction / p.target : 1,
          fmt::format("compaction {:.3f} of {:g}  step {}  {:.1f} M particle-steps/s  {} left", p.compaction, p.target,
                      p.step, 1e-6 * p.particle_steps_per_s, duration(p.eta_s))};
}

mpm::Options engine_options(const cases::Case& c) {
  auto options = c.mpm;
  options.threads = cases::thread_count(c);
  options.timed = true;
  return options;
}

PressOutcome press(const Formed& formed, press::Sink<2> keep, const std::optional<press::Checkpoint<2>>& resume,
                   Observer& observer) {
  const auto& c = formed.c;
  if (cases::presses_hot(c)) return press_hot(formed, keep, resume, observer);
  keep.progress = [&observer](const press::Progress& p) { observer.progress(progress_of(p)); };
  keep.cancelled = [&observer] { return observer.cancelled(); };
  const auto setup = press::setup(formed.panel, c.grid, c.sides, engine_options(c));
  PressOutcome outcome{press::press(formed.panel, c.schedule, setup, keep, resume), std::nullopt};
  for (const auto& warning : outcome.warnings) observer.warn(warning);
  return outcome;
}

Pressed press(const Formed& formed, Observer& observer) {
  Pressed pressed;
  press::Sink<2> keep;
  keep.snapshot = [&pressed](const Panel<2>& panel, int /*index*/) { pressed.panels.push_back(panel); };
  pressed.outcome = press(formed, std::move(keep), std::nullopt, observer);
  return pressed;
}

Shapes shapes_of(const cases::Case& c, const std::vector<Panel<2>>& panels) {
  Shapes shapes;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const double compaction = c.schedule.compactions[i];
    shapes.morphologies.push_back(report::morphology(panels[i], compaction));
    shapes.density_profiles.push_back(profile::density_profile(panels[i], bins_of_one_cell(c, panels[i], compaction)));
    shapes.density_profiles.back().compaction = compaction;  // as in the other tables; the panel is a time step beyond
  }
  return shapes;
}

std::vector<report::Finding> findings_of(const cases::Case& c, const std::vector<press::Record>& records,
                                         const std::vector<std::string>& warnings, const Shapes& shapes) {
  auto findings = report::pressing_findings(records, press::judged_from(c.schedule), warnings);
  for (const auto& more :
       {report::pressure_findings(records), report::profile_findings(shapes.density_profiles),
        report::softening_findings(cases::strand_kinds(c)), report::shape_findings(shapes.morphologies)})
    findings.insert(findings.end(), more.begin(), more.end());
  return findings;
}

}  // namespace strandlab::run
