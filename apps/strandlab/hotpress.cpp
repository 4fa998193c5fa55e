// strandlab hotpress: a hot press cycle through the thickness of a case's mat, in a second.
#include "strandlab/case/hotpress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

#include "case_arguments.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "git_hash.hpp"
#include "strandlab/case/write.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/core/version.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/files/json_text.hpp"
#include "strandlab/report/hotpress_results.hpp"

namespace strandlab::app {
namespace {

namespace fs = std::filesystem;

constexpr std::array kFiles{"case.toml", "hotpress.csv", "transfer_profiles.csv", "run.json"};

// Results of `strandlab run` are no hot press of ours to replace: their run.json knows of panels.
void refuse_folder(const fs::path& folder, bool force) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InputError(fmt::format("{}: this is a file, not a folder; choose another with -o", folder.string()));
  const auto there = [&](const char* name) { return fs::exists(folder / name, error); };
  if (std::none_of(kFiles.begin(), kFiles.end(), there)) return;
  if (there("run.json")) {
    const auto record = files::read_json(folder / "run.json", "the record of a hot press");
    if (!record.is_object() || record.contains("steps"))
      throw InputError(
          fmt::format("{}: holds the panels of strandlab run; choose another folder with -o", folder.string()));
  }
  if (!force)
    throw InputError(
        fmt::format("{}: has results already; --force replaces them, -o chooses another folder", folder.string()));
}

std::vector<std::string> remarks_on(const cases::Case& c) {
  std::vector<std::string> list;
  if (!c.hotpress.given) list.push_back("the case has no [hotpress]: the default cycle is pressed (docs/hotpress.md)");
  for (const auto& kind : c.kinds) {
    if (kind.law != wood::Law::kHill) continue;
    list.push_back(
        fmt::format("kinds.{} has law = \"hill\", under which no density profile emerges; the column takes the "
                    "crushing constants of its material",
                    kind.name));
  }
  return list;
}

void press(const CaseArguments& arguments) {
  auto c = arguments.read();
  const auto folder = arguments.folder.empty() ? fs::path("runs") / (c.name + "_hotpress") : fs::path(arguments.folder);
  refuse_folder(folder, arguments.force);
  auto notes = remarks_on(c);
  const auto mat = cases::make_mat(c);
  const auto result = hotpress::press_in_band(cases::hotpress_settings(c), cases::pressed_mat(c, mat));
  notes.insert(notes.end(), result.cycle.warnings.begin(), result.cycle.warnings.end());
  for (const auto& remark : hotpress::remarks(result.cycle, result.answers)) notes.push_back(remark);

  files::make_folder(folder);
  fs::remove(folder / "run.json");  // written last again: a kill in between leaves no record beside other results
  c.hotpress.given = true;          // the file shows all keys that were used
  files::write_atomically(folder / "case.toml", cases::resolved_text(c));
  report::hotpress_table(result.cycle).write(folder / "hotpress.csv");
  report::profiles_table(result.cycle).write(folder / "transfer_profiles.csv");
  const nlohmann::json record{
      {"strandlab", version()}, {"git", kGitHash}, {"hotpress", report::to_json(result)}, {"warnings", notes}};
  files::write_atomically(folder / "run.json", record.dump(2) + "\n");
  for (const auto& line : report::summary(result)) print("{}\n", printable(line));
  for (const auto& note : notes) tell(STDERR_FILENO, fmt::format("warning: {}\n", printable(note)));
  print("{}: hotpress.csv, transfer_profiles.csv, run.json\n", printable(folder.string()));
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
