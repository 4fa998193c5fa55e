// strandlab report: report.html of a run folder.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "commands.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/run/page.hpp"
#include "terminal.hpp"

namespace strandlab::app {

void add_report(CLI::App& app) {
  struct ReportArguments {
    std::string folder, out;
  };
  auto arguments = std::make_shared<ReportArguments>();
  auto* command = app.add_subcommand("report", "make report.html of a run folder again");
  command->add_option("DIR", arguments->folder, "run folder")->required();
  command->add_option("-o,--output", arguments->out, "file to write (default: report.html in the run folder)");
  command->callback(
      [arguments] { print("report: {}\n", printable(run::remake_page(arguments->folder, arguments->out).string())); });
}

}  // namespace strandlab::app
