// strandlab init: a commented case to start from, or the reference page of all keys.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.hpp"
#include "console.hpp"
#include "strandlab/core/nearest.hpp"
#include "strandlab/io/case.hpp"
#include "strandlab/io/case_write.hpp"

namespace strandlab::app {
namespace {

struct Arguments {
  std::string name = "osb";
  bool reference = false;
};

void init(const Arguments& arguments) {
  if (arguments.reference) {
    print("{}", io::reference_text());
    return;
  }
  const auto c = io::ready_case(arguments.name);
  print("{}", io::commented_text(c, io::ready_case_title(arguments.name)));
}

}  // namespace

void add_init(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  auto* command = app.add_subcommand("init", "print a commented case to start from");
  command->add_option("NAME", arguments->name, "ready case: " + quoted_list(io::ready_cases()))->capture_default_str();
  command->add_flag("--reference", arguments->reference, "print the reference page of all keys instead");
  command->callback([arguments] { init(*arguments); });
}

}  // namespace strandlab::app
