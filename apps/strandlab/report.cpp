// strandlab report: report.html of a run folder.
#include "report.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "console.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/report/html.hpp"
#include "strandlab/run/folder.hpp"
#include "strandlab/run/page.hpp"

namespace strandlab::app {

std::filesystem::path write_report_page(const std::filesystem::path& run_folder, const std::filesystem::path& out) {
  const auto page = report::empty_page();
  auto file = out.empty() ? run_folder / "report.html" : out;
  files::write_atomically(file, report::filled_page(page, run::report_data(run_folder)));
  return file;
}

namespace {

// The folder's own page is one of its results; a page elsewhere is the user's file.
std::filesystem::path make_page(const std::filesystem::path& run_folder, const std::filesystem::path& out) {
  if (!out.empty()) return write_report_page(run_folder, out);
  std::filesystem::path page;
  run::write_page(run_folder, [&] { page = write_report_page(run_folder); });
  return page;
}

}  // namespace

void add_report(CLI::App& app) {
  struct Arguments {
    std::string folder, out;
  };
  auto arguments = std::make_shared<Arguments>();
  auto* command = app.add_subcommand("report", "make report.html of a run folder again");
  command->add_option("DIR", arguments->folder, "run folder")->required();
  command->add_option("-o,--output", arguments->out, "file to write (default: report.html in the run folder)");
  command->callback(
      [arguments] { print("report: {}\n", printable(make_page(arguments->folder, arguments->out).string())); });
}

}  // namespace strandlab::app
