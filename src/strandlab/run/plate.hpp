// Plates: the mat of a case whose mat file is in 3D, tested as it lies. Pressing is still to come.
#pragma once

#include <vector>

#include "strandlab/case/plate.hpp"
#include "strandlab/report/result_tables.hpp"
#include "strandlab/run/folder.hpp"
#include "strandlab/run/observer.hpp"

namespace strandlab::run {

struct FormedPlate {
  cases::Case c;
  mat::PlateMat mat;
  Panel<3> panel;
};

// Reads the mat of the case and makes its panel. Throws InputError as cases::make_plate_mat() and make_panel().
FormedPlate form_plate(cases::Case c);

// Tests the plate, in memory: says first what it will take. Throws InputError where that is more memory than is free or
// where the plate cannot be tested, RunError where the tests fail, Cancelled when the observer stops them.
vtest::PlateResult test_plate(const FormedPlate& formed, Observer& observer);

std::vector<report::PanelModulus> moduli_of(const FormedPlate& formed, const vtest::PlateResult& result);

// Both, into a run folder: mat.json, moduli.csv and, of a periodic plate, abd.csv. Not repeated where they are there.
// Throws as above, and as a journey's step (journey.hpp) for a folder that cannot be used.
void plate(const cases::Case& c, const Place& place, Observer& observer);

}  // namespace strandlab::run
