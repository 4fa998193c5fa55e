#include "strandlab/run/plate.hpp"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <filesystem>
#include <utility>

#include "strandlab/core/error.hpp"
#include "strandlab/core/free_memory.hpp"
#include "strandlab/core/stopwatch.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/files/text_file.hpp"
#include "strandlab/run/composition.hpp"
#include "strandlab/run/log.hpp"
#include "strandlab/run/record.hpp"

namespace strandlab::run {
namespace {

namespace fs = std::filesystem;
using cases::Step;

void refuse_too_large(const vtest::PlateSize& size) {
  const double free_GB = 1e-9 * free_memory_bytes();
  if (size.memory_GB <= free_GB) return;
  throw InputError(
      fmt::format("the tests of this plate have {} unknowns and need about {:.1f} GB of memory, {:.1f} GB are free; "
                  "take larger elements (test.element_length_mm, test.elements_through_strand)",
                  size.unknowns, size.memory_GB, free_GB));
}

void tell(const vtest::PlateResult& result, Observer& observer) {
  for (const auto& warning : result.warnings) observer.warn(warning);
  if (result.floating_strands > 0) {
    observer.say(
        fmt::format("test: {} of {} strands are not part of the largest piece that glue holds together and are "
                    "left out",
                    result.floating_strands, result.strands));
  }
  for (const auto& m : result.moduli)
    observer.say(fmt::format("test: {}, 1/D_t = {}: {:.4g} MPa", m.test, m.compliance_t_mm_per_MPa, m.modulus_MPa));
}

void form_into(const FormedPlate& formed, RunFolder& folder, Observer& observer) {
  const auto file = folder.file("mat.json");
  const auto text = mat::to_text(formed.mat);
  if (folder.finished(Step::kMat) && fs::exists(file)) {
    if (files::read_text(file) == text) return;
    throw InputError(
        fmt::format("{}: not the mat of this case (changed by hand, or the mat file has changed since); "
                    "choose another run folder with -o, or --force",
                    file.string()));
  }
  folder.forget(Step::kMat);
  files::write_atomically(file, text);
  folder.set_finished(Step::kMat);
  observer.say(fmt::format("mat: {} layers, {} strands, {:g} x {:g} mm -> {}", formed.mat.layers.size(),
                           formed.panel.strands.size(), formed.mat.length_mm, formed.mat.width_mm, file.string()));
  for (const auto& line : composition(cases::weigh(formed.c, formed.mat))) observer.say("mat: " + line);
}

void write_results(const FormedPlate& formed, const vtest::PlateResult& result, RunFolder& folder) {
  report::moduli_table(moduli_of(formed, result)).write(folder.file("moduli.csv"));
  if (!result.tensors.empty()) report::plate_table(0, result).write(folder.file("abd.csv"));
}

bool is_tested(const RunFolder& folder, const FormedPlate& formed) {
  return folder.finished(Step::kTest) && fs::exists(folder.file("moduli.csv")) &&
         (!formed.panel.periodic || fs::exists(folder.file("abd.csv")));
}

}  // namespace

FormedPlate form_plate(cases::Case c) {
  auto mat = cases::make_plate_mat(c);
  c.schedule.compactions = {0};
  auto panel = cases::make_panel(c, mat);
  return {std::move(c), std::move(mat), std::move(panel)};
}

vtest::PlateResult test_plate(const FormedPlate& formed, Observer& observer) {
  const auto options = cases::plate_options(formed.c);
  const auto size = vtest::size_of_tests(formed.panel, options);
  observer.say(fmt::format("test: {} unknowns, about {:.1f} GB of memory", size.unknowns, size.memory_GB));
  refuse_too_large(size);
  auto result = vtest::measure(formed.panel, options, [&observer] { stop_if_cancelled(observer); });
  tell(result, observer);
  return result;
}

std::vector<report::PanelModulus> moduli_of(const FormedPlate& formed, const vtest::PlateResult& result) {
  const double density = 1e3 * cases::weigh(formed.c, formed.mat).kg_per_m2 / formed.mat.thickness_mm();
  std::vector<report::PanelModulus> moduli;
  for (const auto& m : result.moduli) {
    moduli.push_back(
        {0, m.test, m.compliance_t_mm_per_MPa, m.modulus_MPa, m.reaction_modulus_MPa, std::nullopt, density});
  }
  return moduli;
}

void plate(const cases::Case& c, const Place& place, Observer& observer) {
  const auto formed = form_plate(c);
  constexpr double kBytes = 1e6;  // of tables and text
  RunFolder folder(place.folder, formed.c, Step::kMat, place.force, kBytes);
  Log log(observer);
  begin_record(folder.record(), formed);
  form_into(formed, folder, log);
  if (is_tested(folder, formed)) {
    log.say(fmt::format("{}: this run is finished; --force runs it again", folder.path().string()));
    return;
  }
  log.open(folder.file("log.txt"));
  try {
    double wall_s = 0;
    vtest::PlateResult result;
    {
      const Stopwatch watch(wall_s);
      result = test_plate(formed, log);
    }
    write_results(formed, result, folder);
    auto& record = folder.record(Step::kTest);
    record = run::to_json(result);
    record["wall_s"] = wall_s;
    folder.set_finished(Step::kTest);
    log.say(fmt::format("test: {} moduli -> {}", result.moduli.size(), folder.file("moduli.csv").string()));
  } catch (const std::exception& e) {
    log.keep_error(e.what());
    throw;
  }
}

}  // namespace strandlab::run
