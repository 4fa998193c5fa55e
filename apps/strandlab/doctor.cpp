// strandlab doctor: what of this machine strandlab can use, and whether it computes right.
#include "strandlab/run/doctor.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "commands.hpp"
#include "strandlab/core/error.hpp"
#include "terminal.hpp"

namespace strandlab::app {

void add_doctor(CLI::App& app) {
  app.add_subcommand("doctor", "what this machine has of what strandlab can use, and a self-test")->callback([] {
    const auto list = run::diagnose();
    print("{}", run::text_of(list));
    const auto wrong = [](const run::Diagnosis& d) { return d.state == run::Diagnosis::State::kBad; };
    if (std::any_of(list.begin(), list.end(), wrong)) throw RunError("something is wrong with this build");
  });
}

}  // namespace strandlab::app
