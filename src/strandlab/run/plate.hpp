// Plates: the mat of a case in 3D formed, pressed and tested, in memory and into a run folder.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "strandlab/case/plate.hpp"
#include "strandlab/case/write.hpp"
#include "strandlab/press/press.hpp"
#include "strandlab/report/result_tables.hpp"
#include "strandlab/run/folder.hpp"
#include "strandlab/run/observer.hpp"

namespace strandlab::run {

struct FormedPlate {
  cases::Case c;  // with the compactions at which this mat has the states asked for
  mat::PlateMat mat;
  Panel<3> panel;
};

// Reads or forms the mat of the case and makes its panel. Throws InputError as cases::make_plate_mat(),
// settle_states() and make_panel().
FormedPlate form_plate(cases::Case c);

// Presses the plate through the compactions of its case: `keep` is told all but progress, which the observer hears, and
// may go on from a checkpoint. Throws InputError where that needs more memory than is free, RunError for a pressing
// that fails, Cancelled when the observer stops it.
press::Outcome<3> press_plate(const FormedPlate& formed, press::Sink<3> keep,
                              const std::optional<press::Checkpoint<3>>& resume, Observer& observer);

// The tests of a plate at one compaction.
struct TestedPlateState {
  double compaction = 0;
  vtest::PlateResult result;
  double wall_s = 0;
  std::string not_testable;  // why, where no glue holds the panel together or the tests fail; the result is then empty
};
using TestedPlate = std::vector<TestedPlateState>;

// Tests one panel of the plate: says first what it will take. Throws InputError where that is more memory than is free
// or for options it cannot use, Cancelled when the observer stops them.
TestedPlateState test_plate(const FormedPlate& formed, const Panel<3>& panel, double compaction, Observer& observer);

std::vector<report::PanelModulus> moduli_of(const FormedPlate& formed, const TestedPlate& tested);

// The steps up to `last`, into a run folder: mat.json; of a case that presses press.csv, panels and ParaView files;
// moduli.csv and, of a periodic plate, abd.csv. Steps whose results are there are not repeated, and a pressing goes on
// where it was stopped. Throws as above, InputError where the plate can be tested at none of its compactions, and as a
// journey's step (journey.hpp) for a folder that cannot be used.
void plate(const cases::Case& c, const Place& place, Observer& observer, cases::Step last = cases::Step::kTest);

}  // namespace strandlab::run
