// strandlab run: the whole journey, mat -> press -> virtual tests -> files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.hpp"
#include "journey.hpp"

namespace strandlab::app {
namespace {

void run(const CaseArguments& arguments) {
  travel(arguments, io::Step::kMat, [](Journey& journey, Console& console) {
    if (journey.folder.finished(io::Step::kTest)) {
      console.say(fmt::format("{}: this run is finished; --force runs it again", journey.folder.path().string()));
      return;
    }
    do_mat(journey, console);
    do_press(journey, console);
    do_test(journey, console);
  });
}

}  // namespace

void add_run(CLI::App& app) {
  auto arguments = std::make_shared<CaseArguments>();
  auto* command = app.add_subcommand("run", "form, press and test: the whole journey of a panel");
  add_case_arguments(*command, *arguments);
  add_folder_arguments(*command, *arguments);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strandlab::app
