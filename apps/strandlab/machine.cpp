// strandlab bench: how fast this machine is on the main job. strandlab doctor: what it has that strandlab can use.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "commands.hpp"
#include "strandlab/benchmark/text.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/run/doctor.hpp"
#include "terminal.hpp"

namespace strandlab::app {

void add_bench(CLI::App& app) {
  struct BenchArguments {
    bool json = false;
    int repeats = 5;
    int threads = 0;
  };
  auto* command = app.add_subcommand("bench", "Measure how fast this machine presses and tests the main job's mat");
  auto arguments = std::make_shared<BenchArguments>();
  command->add_flag("--json", arguments->json, "print a list of objects, one per thread count");
  command->add_option("--repeats", arguments->repeats, "measurements per figure; the median is printed")
      ->check(CLI::Range(1, 100));
  command->add_option("--threads", arguments->threads, "largest thread count (default: all cores)")
      ->check(CLI::Range(1, 1024));
  command->callback([arguments] {
    const auto counts = benchmark::thread_counts(arguments->threads);
    const auto results = benchmark::run(counts, arguments->repeats, [](const std::string& what) {
      tell(STDERR_FILENO, fmt::format("bench: {}...\n", what));
    });
    print("{}", arguments->json ? benchmark::json_of(results) : benchmark::text_of(results));
  });
}

void add_doctor(CLI::App& app) {
  app.add_subcommand("doctor", "what this machine has of what strandlab can use, and a self-test")->callback([] {
    const auto list = run::diagnose();
    print("{}", run::text_of(list));
    const auto wrong = [](const run::Diagnosis& d) { return d.state == run::Diagnosis::State::kBad; };
    if (std::any_of(list.begin(), list.end(), wrong)) throw RunError("something is wrong with this build");
  });
}

}  // namespace strandlab::app
