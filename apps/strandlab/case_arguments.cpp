#include "case_arguments.hpp"

#include <CLI/CLI.hpp>

namespace strandlab::app {

std::filesystem::path CaseArguments::run_folder(const cases::Case& c) const {
  return folder.empty() ? std::filesystem::path("runs") / c.name : std::filesystem::path(folder);
}

void add_case_arguments(CLI::App& command, CaseArguments& arguments) {
  command.add_option("CASE", arguments.file, "case file; to make one: strandlab init osb > panel.toml")->required();
  command
      .add_option("--set", arguments.overrides,
                  "key.path=value: overrides a key of the case, as in --set press.speed_m_s=8; may be repeated")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
}

void add_folder_arguments(CLI::App& command, CaseArguments& arguments) {
  command.add_option("-o,--output", arguments.folder, "run folder; default runs/<name of the case>")->type_name("DIR");
  command.add_flag("--force", arguments.force, "replace results that are already in the run folder");
}

}  // namespace strandlab::app
