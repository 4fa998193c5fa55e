// The journey of a panel through a run folder, mat -> press -> test; each step goes on from what the folder holds.
#pragma once

#include <functional>

#include "case_arguments.hpp"
#include "console.hpp"
#include "strandlab/run/folder.hpp"

namespace strandlab::app {

struct Journey {
  cases::Case c;
  mat::Mat mat;
  Panel<2> panel;  // before pressing
  run::RunFolder folder;
};

// Reads and checks the case for all steps up to `last`, opens its run folder (with --force the steps from `first` on
// start again) and takes the steps; an exception that ends them is logged. Throws InputError with nothing written for
// bad input.
void travel(const CaseArguments& arguments, cases::Step first, cases::Step last,
            const std::function<void(Journey&, Console&)>& steps);

// Throws InputError, with the remedy, where a panel of the finished pressing is no longer there.
void refuse_missing_panels(const Journey& journey);

// Each does its step unless the folder has it already, and says so; what is missing of a finished step is made again
// where that needs no simulation. Throws InputError where a file of the folder is needed and cannot be used, RunError
// for a failed simulation.
void do_mat(Journey& journey, Console& console);
void do_press(Journey& journey, Console& console);
void do_test(Journey& journey, Console& console);

}  // namespace strandlab::app
