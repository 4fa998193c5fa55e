#include "strandlab/benchmark/text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace strandlab::benchmark {
namespace {

nlohmann::json to_json(const mpm::Phases& p) {
  return {{"weights", p.weights}, {"scatter", p.scatter}, {"surface", p.surface},  {"grid", p.grid},
          {"contact", p.contact}, {"gather", p.gather},   {"material", p.material}};
}

nlohmann::json to_json(const Result& r) {
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

std::string phases_text(const char* name, const mpm::Phases& p) {
  return fmt::format(
      "    {:<10} weights {:.1f}  scatter {:.1f}  surface {:.1f}  grid {:.1f}  contact {:.1f}  gather {:.1f}  material "
      "{:.1f}\n",
      name, p.weights, p.scatter, p.surface, p.grid, p.contact, p.gather, p.material);
}

std::string text_of(const Result& r, const Result& first) {
  auto text = fmt::format("{} thread{}: machine {:.0f} GFLOP/s (FMA), {:.0f} GB/s (triad)\n", r.threads,
                          r.threads > 1 ? "s" : "", r.machine.fma_gflops, r.machine.triad_gb_s);
  text +=
      fmt::format("  elastic with contact   {:6.1f} ns per particle-step (speed-up {:.2f})\n",
                  r.elastic_ns_per_particle_step, first.elastic_ns_per_particle_step / r.elastic_ns_per_particle_step);
  text +=
      fmt::format("  mid-press              {:6.1f} ns ({:.0f} % plastic, {:.2f} fields per node; speed-up {:.2f})\n",
                  r.press_ns_per_particle_step, 100 * r.plastic_fraction, r.fields_per_node,
                  first.press_ns_per_particle_step / r.press_ns_per_particle_step);
  text += fmt::format("  one body, no contact   {:6.1f} ns: contact and fields cost {:.0f} %\n",
                      r.one_body_ns_per_particle_step,
                      100 * (r.elastic_ns_per_particle_step / r.one_body_ns_per_particle_step - 1));
  text += fmt::format("  3D elastic             {:6.1f} ns\n", r.elastic_3d_ns_per_particle_step);
  text += fmt::format("  static solve           {:6.2f} s per 1/D_t at 3 elements, {:.2f} s at 6\n", r.static_solve_s,
                      r.static_solve_fine_s);
  text +=
      fmt::format("  memory                 {:6.0f} bytes per particle in the engine, peak of the process {:.0f} MB\n",
                  r.bytes_per_particle, r.peak_memory_mb);
  text += fmt::format("  split by phase, timed (the clock adds a few ns), ns per particle-step, threads added up:\n");
  text += phases_text("elastic", r.elastic_phases);
  text += phases_text("mid-press", r.press_phases);
  return text;
}

}  // namespace

std::string text_of(const std::vector<Result>& results) {
  std::string text;
  for (const auto& r : results) text += text_of(r, results.front());
  return text;
}

std::string json_of(const std::vector<Result>& results) {
  auto list = nlohmann::json::array();
  for (const auto& r : results) list.push_back(to_json(r));
  return list.dump(2) + "\n";
}

}  // namespace strandlab::benchmark
