// strandlab hotpress: a hot press cycle through the thickness of a case's mat, in a second.
#include "strandlab/run/hotpress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "case_arguments.hpp"
#include "commands.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/report/hotpress_results.hpp"
#include "terminal.hpp"

namespace strandlab::app {
namespace {

void press(const CaseArguments& arguments) {
  const auto c = arguments.read();
  const run::Place place{arguments.folder.empty() ? std::filesystem::path("runs") / (c.name + "_hotpress")
                                                  : std::filesystem::path(arguments.folder),
                         arguments.force};
  run::Observer silent;
  const auto pressed = run::hotpress(c, place, silent);
  for (const auto& line : report::summary(pressed.band)) print("{}\n", printable(line));
  for (const auto& note : pressed.notes) tell(STDERR_FILENO, fmt::format("warning: {}\n", printable(note)));
  print("{}: hotpress.csv, transfer_profiles.csv, run.json\n", printable(place.folder.string()));
}

}  // namespace

void add_hotpress(CLI::App& app) {
  auto arguments = std::make_shared<CaseArguments>();
  auto* command = app.add_subcommand("hotpress", "how long to press: a hot press cycle through the thickness, at once");
  add_case_arguments(*command, *arguments);
  command->add_option("-o,--output", arguments->folder, "folder of results; default runs/<name of the case>_hotpress")
      ->type_name("DIR");
  command->add_flag("--force", arguments->force, "replace results that are already there");
  command->callback([arguments] { press(*arguments); });
}

}  // namespace strandlab::app
