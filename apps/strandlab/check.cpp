// strandlab check: the resolved case and what it will cost, before anything runs.
#include "strandlab/run/check.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "case_arguments.hpp"
#include "commands.hpp"
#include "terminal.hpp"

namespace strandlab::app {

void add_check(CLI::App& app) {
  auto arguments = std::make_shared<CaseArguments>();
  auto* command =
      app.add_subcommand("check", "check a case; print it resolved, with particles, steps, memory and run time");
  add_case_arguments(*command, *arguments);
  command->callback([arguments] { print("{}", run::checked_text(arguments->read())); });
}

}  // namespace strandlab::app
