// strandlab: a virtual laboratory for wood-strand composites.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "commands.hpp"
#include "process.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/input_errors.hpp"
#include "strandlab/core/nearest.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/core/version.hpp"
#include "strandlab/mpm/dispatch.hpp"
#include "strandlab/run/commit.hpp"
#include "terminal.hpp"

namespace {

enum Exit { kDone = 0, kBadInput = 2, kFailed = 3 };

int fail(Exit code, const char* what) {
  strandlab::app::tell(STDERR_FILENO, fmt::format("strandlab: {}\n", strandlab::one_line(what)));
  return code;
}

// An unknown command is answered by the nearest one.
void refuse_unknown_command(const CLI::App& app, const std::string& given) {
  std::vector<std::string> names;
  for (const auto* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), given) != names.end()) return;
  const auto near = strandlab::nearest(given, names);
  throw strandlab::InputError(fmt::format("unknown command \"{}\"{} Commands: {}", strandlab::shortened(given),
                                          near.empty() ? "." : fmt::format("; did you mean \"{}\"?", near),
                                          strandlab::quoted_list(names)));
}

// The shell takes --set press.compactions=[0, 0.4] apart at its space.
std::string list_hint(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.find("=[") != std::string::npos && argument.find(']') == std::string::npos)
      return fmt::format(" A list needs quotes, or no spaces: --set '{} ...]'.", strandlab::shortened(argument));
  }
  return {};
}

int run(int argc, char** argv) {
  CLI::App app("Presses random strand mats and measures the moduli of the panels.", "strandlab");
  app.set_version_flag("--version",
                       fmt::format("strandlab {} ({})", strandlab::version(), strandlab::run::git_commit()));
  app.require_subcommand(1);
  app.failure_message([&](const CLI::App*, const CLI::Error& e) {
    return fmt::format("{}\nRun with --help for more information.\n",
                       strandlab::one_line(e.what() + list_hint(argc, argv)));
  });
  using namespace strandlab::app;
  for (const auto add :
       {add_init, add_check, add_mat, add_form, add_press, add_test, add_run, add_report, add_figures, add_movie,
        add_theory, add_bondline, add_hotpress, add_profile, add_study, add_compare, add_bench, add_doctor})
    add(app);
  if (argc > 1 && argv[1][0] != '-') refuse_unknown_command(app, argv[1]);
  strandlab::mpm::instruction_set();  // STRANDLAB_ISA is refused before any file is written
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (app.exit(e) != 0) return kBadInput;
  }
  refuse_lost_output();
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    strandlab::app::prepare_process();
    return run(argc, argv);
  } catch (const strandlab::InputErrors& e) {
    for (const auto& message : e.messages) fail(kBadInput, message.c_str());
    return kBadInput;
  } catch (const strandlab::InputError& e) {
    return fail(kBadInput, e.what());
  } catch (const std::bad_alloc&) {
    return fail(kFailed, "out of memory");
  } catch (const std::exception& e) {
    return fail(kFailed, e.what());
  }
}
