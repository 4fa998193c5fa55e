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
  auto& folder = journey.folder;
  if (folder.finished(cases::Step::kPage) && folder.missing(cases::Step::kPage, journey.c).empty()) return;
  try {
    const auto page = write_report_page(folder.path());
    folder.set_finished(cases::Step::kPage);
    console.say(fmt::format("report: {}", page.string()));
  } catch (const std::exception& e) {
    console.warn(fmt::format("no report.html: {}", e.what()));
  }
}

// Whether all results but the page are there.
bool is_done(const Journey& journey) {
  const auto there = [&](cases::Step step) {
    return journey.folder.finished(step) && journey.folder.missing(step, journey.c).empty();
  };
  return there(cases::Step::kMat) && there(cases::Step::kPress) && there(cases::Step::kTest);
}

void run(const CaseArguments& arguments) {
  travel(arguments, cases::Step::kMat, cases::Step::kPage, [](Journey& journey, Console& console) {
    const bool done = is_done(journey);
    if (!done) {
      do_mat(journey, console);
      do_press(journey, console);
      do_test(journey, console);
    }
    do_report(journey, console);
    if (done)
      console.say(fmt::format("{}: this run is finished; --force runs it again", journey.folder.path().string()));
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
