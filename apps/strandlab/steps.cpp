// strandlab mat, press, test, run: the steps of a panel's journey, into a run folder.
#include <CLI/CLI.hpp>
#include <memory>

#include "case_arguments.hpp"
#include "commands.hpp"
#include "strandlab/run/journey.hpp"
#include "strandlab/run/plate.hpp"
#include "terminal.hpp"

namespace strandlab::app {
namespace {

template <class Step>
void add_step(CLI::App& app, const char* name, const char* description, const Step& step) {
  auto arguments = std::make_shared<CaseArguments>();
  auto* command = app.add_subcommand(name, description);
  add_case_arguments(*command, *arguments);
  add_folder_arguments(*command, *arguments);
  command->callback([arguments, step] {
    const auto c = arguments->read();
    Terminal terminal;
    step(c, run::Place{arguments->run_folder(c), arguments->force}, terminal);
  });
}

}  // namespace

void add_mat(CLI::App& app) {
  add_step(app, "mat", "form the mat of a case: mat.json", [](const auto& c, const auto& place, auto& observer) {
    cases::has_plate_mat(c) ? run::plate(c, place, observer, cases::Step::kMat) : void(run::form(c, place, observer));
  });
}

void add_press(CLI::App& app) {
  add_step(app, "press", "press the mat of a case: press.csv, panels, pictures",
           [](const auto& c, const auto& place, auto& observer) {
             cases::has_plate_mat(c) ? run::plate(c, place, observer, cases::Step::kPress)
                                     : run::press(c, place, observer);
           });
}

void add_test(CLI::App& app) {
  add_step(app, "test", "measure the moduli of the pressed panel: moduli.csv",
           [](const auto& c, const auto& place, auto& observer) {
             cases::has_plate_mat(c) ? run::plate(c, place, observer) : void(run::test(c, place, observer));
           });
}

void add_run(CLI::App& app) {
  add_step(app, "run", "form, press and test: the whole journey of a panel",
           [](const auto& c, const auto& place, auto& observer) {
             cases::has_plate_mat(c) ? run::plate(c, place, observer) : void(run::all(c, place, observer));
           });
}

}  // namespace strandlab::app
