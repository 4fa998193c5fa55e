// strandlab run: the whole journey, mat -> press -> virtual tests -> files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <memory>

#include "commands.hpp"
#include "journey.hpp"
#include "report.hpp"

namespace strandlab::app {
namespace {

// The report follows from the files that are there: a run does not fail for the want of its page.
void do_report(Journey& journey, Console& console) {
  try {
    console.say(fmt::format("report: {}", write_report_page(journey.folder.path()).string()));
  } catch (const std::exception& e) {
    console.warn(fmt::format("no report.html: {}", e.what()));
  }
}

void run(const CaseArguments& arguments) {
  travel(arguments, io::Step::kMat, [](Journey& journey, Console& console) {
    if (journey.folder.finished(io::Step::kTest)) {
      if (!std::filesystem::exists(journey.folder.file("report.html"))) do_report(journey, console);
      console.say(fmt::format("{}: this run is finished; --force runs it again", journey.folder.path().string()));
      return;
    }
    do_mat(journey, console);
    do_press(journey, console);
    do_test(journey, console);
    do_report(journey, console);
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
