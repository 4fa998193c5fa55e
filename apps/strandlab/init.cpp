// strandlab init: a commented case to start from, or the reference page of all keys.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.hpp"
#include "strandlab/case/case.hpp"
#include "strandlab/case/write.hpp"
#include "strandlab/core/nearest.hpp"
#include "terminal.hpp"

namespace strandlab::app {

void add_init(CLI::App& app) {
  struct InitArguments {
    std::string name = "osb";
    bool reference = false;
  };
  auto arguments = std::make_shared<InitArguments>();
  auto* command = app.add_subcommand("init", "print a commented case to start from");
  command->add_option("NAME", arguments->name, "ready case: " + quoted_list(cases::ready_cases()))
      ->capture_default_str();
  command->add_flag("--reference", arguments->reference, "print the reference page of all keys instead");
  command->callback([arguments] {
    const auto& name = arguments->name;
    print("{}", arguments->reference ? cases::reference_text()
                                     : cases::commented_text(cases::ready_case(name), cases::ready_case_title(name)));
  });
}

}  // namespace strandlab::app
