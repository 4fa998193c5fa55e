// strandlab test: virtual tests of the pressed panel at each compaction and glue quality.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>

#include "commands.hpp"
#include "journey.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/io/checkpoint.hpp"
#include "strandlab/report/findings.hpp"
#include "strandlab/report/plots.hpp"
#include "strandlab/report/result_tables.hpp"
#include "strandlab/statics/cholesky.hpp"
#include "strandlab/vtest/vtest.hpp"
#include "theory_curves.hpp"
#include "theory_rows.hpp"

namespace strandlab::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// What run.json keeps of the tests at one compaction; the moduli come back bit for bit.
Json to_json(double compaction, const vtest::Result& result, double wall_s) {
  Json moduli = Json::array();
  for (const auto& m : result.moduli) {
    moduli.push_back({{"test", vtest::name(m.kind)},
                      {"compliance_t_mm_per_MPa", m.compliance_t_mm_per_MPa},
                      {"modulus_MPa", m.modulus_MPa},
                      {"reaction_modulus_MPa", m.reaction_modulus_MPa}});
    if (m.shear_free_modulus_MPa) moduli.back()["shear_free_modulus_MPa"] = *m.shear_free_modulus_MPa;
  }
  return {{"compaction", compaction},
          {"moduli", moduli},
          {"strands", result.strands},
          {"floating_strands", result.floating_strands},
          {"glued_fraction", result.glued_fraction},
          {"unknowns", result.unknowns},
          {"wall_s", wall_s},
          {"assemble_s", result.assemble_s},
          {"analyse_s", result.analyse_s},
          {"factor_s", result.factor_s},
          {"solve_s", result.solve_s},
          {"warnings", result.warnings}};
}

std::vector<report::PanelModulus> moduli_of(const Journey& journey, const Json& states) {
  std::vector<report::PanelModulus> moduli;
  for (const auto& state : states) {
    const double density = io::density_kg_m3(journey.c, journey.mat, state.at("compaction"));
    for (const auto& m : state.at("moduli")) {
      moduli.push_back({state.at("compaction"), m.at("test"), m.at("compliance_t_mm_per_MPa"), m.at("modulus_MPa"),
                        m.at("reaction_modulus_MPa")});
      moduli.back().density_kg_m3 = density;
      if (m.contains("shear_free_modulus_MPa")) moduli.back().shear_free_modulus_MPa = m["shear_free_modulus_MPa"];
    }
  }
  return moduli;
}

std::vector<report::Finding> findings_of(const Json& states) {
  std::vector<report::TestedState> tested;
  for (const auto& state : states) {
    tested.push_back({state.at("compaction"), !state.contains("not_testable"), state.at("floating_strands"),
                      state.at("glued_fraction"), state.at("warnings")});
  }
  return report::test_findings(tested);
}

// Modulus against glue and against compaction for each test, with the closed-form models over them, and these models'
// numbers.
void write_plots(const Journey& journey, const std::vector<report::PanelModulus>& moduli, Console& console) {
  const auto plots = journey.folder.file("plots");
  fs::create_directories(plots);
  const auto theory = theory_moduli(theory_rows(journey.c, journey.mat), moduli, journey.c.off_axis);
  theory_table(theory).write(journey.folder.file("theory.csv"));
  for (const auto kind : journey.c.test.kinds) {
    const std::string test = vtest::name(kind);
    for (const auto& warning :
         {report::plot_modulus_against_compliance(moduli, test, plots / (test + "_against_compliance.png"),
                                                  theory_against_compliance(theory, test)),
          report::plot_modulus_against_compaction(moduli, test, plots / (test + "_against_compaction.png"),
                                                  theory_against_compaction(theory, test))}) {
      if (warning) console.warn(*warning);
    }
  }
}

// Which faces are glued is a choice of the case (glue.max_gap_mm): how much the moduli hang on it, with the softest
// glue. Null when the panel cannot be tested with half or twice the gap, say because half the gap connects nothing.
Json gap_sensitivity(const Panel<2>& panel, vtest::Options options, double compaction, Console& console) {
  auto& compliances = options.compliance_t_mm_per_MPa;
  compliances = {*std::max_element(compliances.begin(), compliances.end())};
  const double gap = options.curing.max_gap_mm;
  try {
    const auto s = vtest::gap_sensitivity(panel, options);
    console.say(fmt::format(
        "test: compaction {}: glue.max_gap_mm = {} changes moduli by at most {:+.1f} % (1/D_t = {}), {} by {:+.1f} %",
        compaction, gap / 2, 100 * s.halved, compliances[0], gap * 2, 100 * s.doubled));
    return {{"compliance_t_mm_per_MPa", compliances[0]}, {"gap_halved", s.halved}, {"gap_doubled", s.doubled}};
  } catch (const statics::OutOfMemory&) {
    throw;
  } catch (const std::runtime_error& error) {  // InputError or RunError
    console.warn(fmt::format("compaction {}: with glue.max_gap_mm = {} or {} the panel cannot be tested: {}",
                             compaction, gap / 2, gap * 2, error.what()));
    return nullptr;
  }
}

// A state that cannot be tested, say because nothing connects its ends, has no moduli; the others still have.
Json not_testable(double compaction, const std::string& reason, bool failed, double wall_s, Console& console) {
  vtest::Result result;
  result.warnings.push_back("This panel cannot be tested: " + reason);
  console.warn(fmt::format("compaction {}: this panel cannot be tested: {}", compaction, reason));
  auto state = to_json(compaction, result, wall_s);
  state["not_testable"] = reason;
  state["failed"] = failed;
  return state;
}

Json measure_state(const Journey& journey, const Panel<2>& panel, double compaction, Console& console) {
  const auto begin = std::chrono::steady_clock::now();
  vtest::Result result;
  try {
    result = vtest::measure(panel, journey.c.test);
  } catch (const InputError& error) {
    return not_testable(compaction, error.what(), false, seconds_since(begin), console);
  } catch (const statics::OutOfMemory&) {
    throw;  // nothing of the panel's: with more memory the run goes on from here
  } catch (const RunError& error) {
    return not_testable(compaction, error.what(), true, seconds_since(begin), console);
  }
  for (const auto& warning : result.warnings) console.warn(fmt::format("compaction {}: {}", compaction, warning));
  if (result.floating_strands > 0) {
    console.say(fmt::format("test: compaction {}: {} of {} strands are not glued to both loaded ends and are left out",
                            compaction, result.floating_strands, result.strands));
  }
  for (std::size_t i = 0; i < std::min(result.moduli.size(), journey.c.test.kinds.size()); ++i) {
    const auto& m = result.moduli[i];
    const auto shear_free =
        m.shear_free_modulus_MPa ? fmt::format(" ({:.0f} without shear)", *m.shear_free_modulus_MPa) : "";
    console.say(fmt::format("test: compaction {}, {}, 1/D_t = {}: {:.0f} MPa{}", compaction, vtest::name(m.kind),
                            m.compliance_t_mm_per_MPa, m.modulus_MPa, shear_free));
  }
  auto state = to_json(compaction, result, seconds_since(begin));
  state["gap_sensitivity"] = gap_sensitivity(panel, journey.c.test, compaction, console);
  if (!result.slips.empty()) {
    fs::create_directories(journey.folder.slip_file(compaction).parent_path());
    report::slip_table(result).write(journey.folder.slip_file(compaction));
  }
  return state;
}

// One panel without moduli is a result; that none has any is an error.
void refuse_if_none_is_testable(const Json& states) {
  const bool any = std::any_of(states.begin(), states.end(), [](const Json& s) { return !s.contains("not_testable"); });
  if (any || states.empty()) return;
  const auto& last = states.back();
  const auto message = fmt::format("no panel can be tested; at compaction {}: {}", last.at("compaction").get<double>(),
                                   last.at("not_testable").get<std::string>());
  if (last.at("failed").get<bool>()) throw RunError(message);
  throw InputError(message);
}

void test_state(Journey& journey, const Panel<2>& panel, double compaction, Console& console) {
  auto& folder = journey.folder;
  const auto state = measure_state(journey, panel, compaction, console);
  auto& states = folder.record(io::Step::kTest)["states"];
  states.push_back(state);
  report::moduli_table(moduli_of(journey, states)).write(folder.file("moduli.csv"));
  folder.save();
}

// Tables that are missing of finished tests follow from the record.
void restore_tables(Journey& journey, Console& console) {
  auto& folder = journey.folder;
  const auto missing = folder.missing(io::Step::kTest, journey.c);
  if (missing.empty()) return;
  console.say(fmt::format("test: made again, as missing: {}", fmt::join(missing, ", ")));
  folder.forget(io::Step::kPage);
  const auto moduli = moduli_of(journey, folder.record(io::Step::kTest)["states"]);
  report::moduli_table(moduli).write(folder.file("moduli.csv"));
  write_plots(journey, moduli, console);
}

void test_alone(const CaseArguments& arguments) {
  travel(arguments, io::Step::kTest, io::Step::kTest, do_test);
}

}  // namespace

void do_test(Journey& journey, Console& console) {
  auto& folder = journey.folder;
  if (folder.finished(io::Step::kTest)) {
    restore_tables(journey, console);
    console.say(fmt::format("test: already done, {}", folder.file("moduli.csv").string()));
    return;
  }
  refuse_missing_panels(journey);
  const auto hash = io::case_hash(journey.c, io::Step::kPress);
  std::vector<Panel<2>> panels;
  for (const double compaction : journey.c.schedule.compactions) {
    panels.push_back(io::read_panel<2>(folder.panel_file(compaction), hash));
  }
  console.log_to(folder.file("log.txt"));
  folder.forget(io::Step::kPage);
  auto& states = folder.record(io::Step::kTest)["states"];
  if (states.is_null()) states = Json::array();
  for (auto i = states.size(); i < panels.size(); ++i) {
    const double compaction = journey.c.schedule.compactions[i];
    console.progress(fmt::format("test   {:3.0f} %  compaction {}",
                                 100.0 * static_cast<double>(i) / static_cast<double>(panels.size()), compaction));
    test_state(journey, panels[i], compaction, console);
  }
  double wall_s = 0;
  for (const auto& state : states) wall_s += state.at("wall_s").get<double>();
  folder.record(io::Step::kTest)["wall_s"] = wall_s;
  refuse_if_none_is_testable(states);
  const auto moduli = moduli_of(journey, states);
  write_plots(journey, moduli, console);
  folder.record(io::Step::kTest)["findings"] = report::to_json(findings_of(states));
  folder.set_finished(io::Step::kTest);
  console.say(fmt::format("test: {} moduli -> {}", moduli.size(), folder.file("moduli.csv").string()));
}

void add_test(CLI::App& app) {
  auto arguments = std::make_shared<CaseArguments>();
  auto* command = app.add_subcommand("test", "measure the moduli of the pressed panel: moduli.csv");
  add_case_arguments(*command, *arguments);
  add_folder_arguments(*command, *arguments);
  command->callback([arguments] { test_alone(*arguments); });
}

}  // namespace strandlab::app
