// strandlab form: the mat of a plate (3D), with pictures of its layers.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "case_arguments.hpp"
#include "commands.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/run/form_plate.hpp"
#include "terminal.hpp"

namespace strandlab::app {
namespace {

void form(const CaseArguments& arguments) {
  const auto c = arguments.read();
  const run::Place place{arguments.folder.empty() ? std::filesystem::path("runs") / (c.name + "_mat")
                                                  : std::filesystem::path(arguments.folder),
                         arguments.force};
  for (const auto& line : run::form_plate_mat(c, place)) print("{}\n", printable(line));
  print("{}: mat.json, layers.csv, pictures\n", printable(place.folder.string()));
}

}  // namespace

void add_form(CLI::App& app) {
  auto arguments = std::make_shared<CaseArguments>();
  auto* command = app.add_subcommand("form", "form the mat of a plate (3D: a case with mat.width_mm): mat.json");
  add_case_arguments(*command, *arguments);
  command->add_option("-o,--output", arguments->folder, "folder of the mat; default runs/<name of the case>_mat")
      ->type_name("DIR");
  command->add_flag("--force", arguments->force, "replace a mat that is already there");
  command->callback([arguments] { form(*arguments); });
}

}  // namespace strandlab::app
