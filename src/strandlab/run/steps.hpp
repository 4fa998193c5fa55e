// The steps of a journey through a run folder; used by journey.cpp.
#pragma once

#include <vector>

#include "strandlab/report/gnuplot.hpp"
#include "strandlab/run/folder.hpp"
#include "strandlab/run/form.hpp"
#include "strandlab/run/log.hpp"
#include "strandlab/run/test.hpp"

namespace strandlab::run {

struct Journey {
  Formed formed;
  RunFolder folder;
  Log log;
};

// Each as the function of journey.hpp.
void form_into(Journey& journey);
void press_into(Journey& journey);
Tested test_into(Journey& journey);
void page_into(Journey& journey);

// Draws plots of a step, warns of those that cannot be drawn, and adds those that are to the step's record: these are
// made again where they are deleted.
void draw_plots(Journey& journey, cases::Step step, const std::vector<report::Picture>& plots);

// The tests that run.json holds. Throws InputError where it is no record of tests.
Tested tested_in(Journey& journey);

// The panels of a finished pressing. Throws InputError, with the remedy, where one is no longer there.
std::vector<Panel<2>> read_panels(const Journey& journey);

}  // namespace strandlab::run
