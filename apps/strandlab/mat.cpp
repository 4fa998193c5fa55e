// strandlab mat: forms (or reads) the mat of a case.
#include <CLI/CLI.hpp>
#include <memory>

#include "commands.hpp"
#include "journey.hpp"

namespace strandlab::app {
namespace {

void make(const CaseArguments& arguments) {
  travel(arguments, cases::Step::kMat, cases::Step::kMat, [](Journey& journey, Console& console) {
    const bool done =
        journey.folder.finished(cases::Step::kMat) && journey.folder.missing(cases::Step::kMat, journey.c).empty();
    do_mat(journey, console);
    if (done) console.say("mat: already in " + journey.folder.path().string());
  });
}

}  // namespace

void add_mat(CLI::App& app) {
  auto arguments = std::make_shared<CaseArguments>();
  auto* command = app.add_subcommand("mat", "form the mat of a case: mat.json");
  add_case_arguments(*command, *arguments);
  add_folder_arguments(*command, *arguments);
  command->callback([arguments] { make(*arguments); });
}

}  // namespace strandlab::app
