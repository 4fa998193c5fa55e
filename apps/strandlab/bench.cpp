// strandlab bench: how fast this machine is on the main job.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "commands.hpp"
#include "console.hpp"
#include "strandlab/benchmark/standard.hpp"

namespace strandlab::app {
namespace {

nlohmann::json to_json(const benchmark::Phases& p) {
  return {{"weights", p.weights}, {"scatter", p.scatter}, {"surface", p.surface},  {"grid", p.grid},
          {"contact", p.contact}, {"gather", p.gather},   {"material", p.material}};
}

nlohmann::json to_json(const benchmark::Result& r) {
  return {{"threads", r.threads},
          {"elastic_ns_per_particle_step", r.elastic_ns_per_particle_step},
          {"press_ns_per_particle_step", r.press_ns_per_particle_step},
          {"one_body_ns_per_particle_step", r.one_body_ns_per_particle_step},
          {"elastic_3d_ns_per_particle_step", r.elastic_3d_ns_per_particle_step},
          {"static_solve_s", r.static_solve_s},
          {"static_solve_6_elements_s", r.static_solve_fine_s},
          {"plastic_fraction", r.plastic_fraction},
          {"fields_per_node", r.fields_per_node},
          {"bytes_per_particle", r.bytes_per_particle},
          {"peak_memory_mb", r.peak_memory_mb},
          {"fma_gflops", r.machine.fma_gflops},
          {"triad_gb_s", r.machine.triad_gb_s},
          {"elastic_phases_ns", to_json(r.elastic_phases)},
          {"press_phases_ns", to_json(r.press_phases)}};
}

void print_phases(const char* name, const benchmark::Phases& p) {
  print(
      "    {:<10} weights {:.1f}  scatter {:.1f}  surface {:.1f}  grid {:.1f}  contact {:.1f}  gather {:.1f}  material "
      "{:.1f}\n",
      name, p.weights, p.scatter, p.surface, p.grid, p.contact, p.gather, p.material);
}

void print_text(const benchmark::Result& r, const benchmark::Result& first) {
  print("{} thread{}: machine {:.0f} GFLOP/s (FMA), {:.0f} GB/s (triad)\n", r.threads, r.threads > 1 ? "s" : "",
        r.machine.fma_gflops, r.machine.triad_gb_s);
  print("  elastic with contact   {:6.1f} ns per particle-step (speed-up {:.2f})\n", r.elastic_ns_per_particle_step,
        first.elastic_ns_per_particle_step / r.elastic_ns_per_particle_step);
  print("  mid-press              {:6.1f} ns ({:.0f} % plastic, {:.2f} fields per node; speed-up {:.2f})\n",
        r.press_ns_per_particle_step, 100 * r.plastic_fraction, r.fields_per_node,
        first.press_ns_per_particle_step / r.press_ns_per_particle_step);
  print("  one body, no contact   {:6.1f} ns: contact and fields cost {:.0f} %\n", r.one_body_ns_per_particle_step,
        100 * (r.elastic_ns_per_particle_step / r.one_body_ns_per_particle_step - 1));
  print("  3D elastic             {:6.1f} ns\n", r.elastic_3d_ns_per_particle_step);
  print("  static solve           {:6.2f} s per 1/D_t at 3 elements, {:.2f} s at 6\n", r.static_solve_s,
        r.static_solve_fine_s);
  print("  memory                 {:6.0f} bytes per particle in the engine, peak of the process {:.0f} MB\n",
        r.bytes_per_particle, r.peak_memory_mb);
  print("  split by phase, profiled (the clock adds a few ns), ns per particle-step, threads added up:\n");
  print_phases("elastic", r.elastic_phases);
  print_phases("mid-press", r.press_phases);
}

}  // namespace

void add_bench(CLI::App& app) {
  struct Arguments {
    bool json = false;
    int repeats = 5;
    int threads = 0;
  };
  auto* command = app.add_subcommand("bench", "Measure how fast this machine presses and tests the main job's mat");
  auto arguments = std::make_shared<Arguments>();
  command->add_flag("--json", arguments->json, "print a list of objects, one per thread count");
  command->add_option("--repeats", arguments->repeats, "measurements per figure; the median is printed")
      ->check(CLI::Range(1, 100));
  command->add_option("--threads", arguments->threads, "largest thread count (default: all cores)")
      ->check(CLI::Range(1, 1024));
  command->callback([arguments] {
    int most = arguments->threads;
    if (most == 0) most = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    std::vector<int> counts{1};
    for (int n = 2; n < most; n *= 2) counts.push_back(n);
    if (most > 1) counts.push_back(most);
    const auto results = benchmark::run(counts, arguments->repeats, [](const std::string& what) {
      tell(STDERR_FILENO, fmt::format("bench: {}...\n", what));
    });
    if (arguments->json) {
      auto list = nlohmann::json::array();
      for (const auto& r : results) list.push_back(to_json(r));
      print("{}\n", list.dump(2));
    } else {
      for (const auto& r : results) print_text(r, results.front());
    }
  });
}

}  // namespace strandlab::app
