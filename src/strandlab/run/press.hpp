// The second step: pressing the mat through the compactions of its case.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "strandlab/hotpress/answers.hpp"
#include "strandlab/press/press.hpp"
#include "strandlab/profile/profile.hpp"
#include "strandlab/report/findings.hpp"
#include "strandlab/report/morphology.hpp"
#include "strandlab/run/form.hpp"
#include "strandlab/run/observer.hpp"

namespace strandlab::run {

// What is read off the panels, one of each per compaction.
struct Shapes {
  std::vector<report::Morphology> morphologies;
  std::vector<profile::Profile> density_profiles;  // in bins of one cell of the press
};

// Records, warnings, speed; of a mat that was pressed hot also its cycle, with its answers in a band of permeability.
struct PressOutcome : press::Outcome<2> {
  std::optional<hotpress::Band> cycle;
};

struct Pressed {
  std::vector<Panel<2>> panels;  // one per compaction of the case
  PressOutcome outcome;
};

// Presses in memory, hot where the case says so (cases::presses_hot): nothing is written. Throws RunError for a
// pressing that fails, Cancelled when the observer stops it.
Pressed press(const Formed& formed, Observer& observer);

// The same for who keeps panels, frames and checkpoints himself as they come, and may go on from one: `keep` is told
// all but progress, which the observer hears.
PressOutcome press(const Formed& formed, press::Sink<2> keep, const std::optional<press::Checkpoint<2>>& resume,
                   Observer& observer);

// What the observer hears of how far a pressing is.
Progress progress_of(const press::Progress& progress);

// Of the panels of a formed mat's case, one per compaction.
Shapes shapes_of(const cases::Case& c, const std::vector<Panel<2>>& panels);

// What records and shapes say, in plain words.
std::vector<report::Finding> findings_of(const cases::Case& c, const std::vector<press::Record>& records,
                                         const std::vector<std::string>& warnings, const Shapes& shapes);

}  // namespace strandlab::run
