// strandlab profile: density profiles of pressed panels, replicates together, beside measured ones.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "commands.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/run/replicates.hpp"
#include "strandlab/run/results.hpp"
#include "terminal.hpp"

namespace strandlab::app {
namespace {

namespace fs = std::filesystem;

struct ProfileArguments {
  run::ProfileQuestion question;
  std::string folder;
  bool force = false;
};

void profile_runs(const ProfileArguments& a) {
  const auto folder = a.folder.empty() ? run::profile_folder(a.question) : fs::path(a.folder);
  run::refuse_results(folder / "profile.csv", a.force);
  const auto answer = run::density_profiles(a.question);
  const auto warnings = run::write(answer, folder);
  print("{}", run::text_of(answer));
  for (const auto& warning : warnings) warn(warning);
  print("written: {}\n", printable(folder.string()));
}

void add_measured_options(CLI::App& command, ProfileArguments& a) {
  command
      .add_option("--measured", a.question.measured,
                  "exports of an X-ray densitometer to draw over the simulated profile")
      ->delimiter(',');
  command
      .add_option("--compaction", a.question.compaction, "compaction to draw (default: the nearest in mean density)")
      ->check(CLI::Range(0.0, 1.0));
  command
      .add_option("--position-column", a.question.columns.position,
                  "measured: number of the column of positions, 1 the first")
      ->check(CLI::Range(1, 10000));
  command.add_option("--density-column", a.question.columns.density, "measured: numbers of the columns of densities")
      ->delimiter(',')
      ->check(CLI::Range(1, 10000));
  command.add_option("--position-unit", a.question.columns.position_unit,
                     "measured: mm, in...; where the file does not say it");
  command.add_option("--density-unit", a.question.columns.density_unit,
                     "measured: kg/m3, g/cm3, lb/ft3; where the file does not say it");
}

}  // namespace

void add_profile(CLI::App& app) {
  auto arguments = std::make_shared<ProfileArguments>();
  auto* command = app.add_subcommand("profile", "density profiles of pressed panels: replicates, measured ones");
  command->add_option("RUN", arguments->question.runs, "run folders; several are replicates: one case, other seeds")
      ->required();
  command->add_option("-o,--output", arguments->folder, "folder for results (default runs/<first run>-profile)");
  command->add_flag("--force", arguments->force, "overwrite results in that folder");
  command
      ->add_option("--bins", arguments->question.bins,
                   "bins through the thickness (default: each one cell of the press high)")
      ->check(CLI::Range(1, 100000));
  add_measured_options(*command, *arguments);
  command->callback([arguments] { profile_runs(*arguments); });
}

}  // namespace strandlab::app
