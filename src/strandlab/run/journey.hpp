// The journey of a panel through a run folder, form -> press -> test -> page: each step goes on from what the folder
// holds, says what it does, and leaves its files and its part of run.json.
#pragma once

#include "strandlab/run/folder.hpp"
#include "strandlab/run/form.hpp"
#include "strandlab/run/observer.hpp"
#include "strandlab/run/test.hpp"

namespace strandlab::run {

// A step is not repeated where the folder has its results; what is missing of them is made again where that needs no
// simulation. All throw InputError, with nothing written, for a case that cannot be run and a folder that cannot be
// used (RunFolder), InputError where a file of the folder is needed and cannot be used, RunError for a failed
// simulation, Cancelled when the observer stops them: called again, they go on from there to the same bits. A log.txt
// in the folder keeps what the observer hears while there is a simulation.

// Leaves mat.json.
Formed form(const cases::Case& c, const Place& place, Observer& observer);
// The mat, and all that is pressed.
void press(const cases::Case& c, const Place& place, Observer& observer);
// Tests the panels that are there. Slips of glue points that were in the folder already are in their files only.
Tested test(const cases::Case& c, const Place& place, Observer& observer);
// Everything, and report.html, for whose want no run fails.
Tested all(const cases::Case& c, const Place& place, Observer& observer);

}  // namespace strandlab::run
