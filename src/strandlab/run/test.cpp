#include "strandlab/run/test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "strandlab/core/error.hpp"
#include "strandlab/report/board_findings.hpp"
#include "strandlab/report/theory_curves.hpp"
#include "strandlab/run/theory_rows.hpp"
#include "strandlab/statics/cholesky.hpp"

namespace strandlab::run {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Which faces are glued is a choice of the case (glue.max_gap_mm): how much the moduli hang on it. None when the panel
// cannot be tested with half or twice the gap, say because half the gap connects nothing.
std::optional<GapSensitivity> gap_sensitivity(const Panel<2>& panel, vtest::Options options, double compaction,
                                              Observer& observer) {
  auto& compliances_t = options.compliance_t_mm_per_MPa;
  compliances_t = {*std::max_element(compliances_t.begin(), compliances_t.end())};
  const double gap = options.curing.max_gap_mm;
  try {
    const auto change = vtest::gap_sensitivity(panel, options, [&observer] { stop_if_cancelled(observer); });
    observer.say(
        fmt::format("test: compaction {}: glue.max_gap_mm = {} changes moduli by at most {:+.1f} % (1/D_t = {:.4g}), "
                    "{} by {:+.1f} %",
                    compaction, gap / 2, 100 * change.halved, compliances_t[0], gap * 2, 100 * change.doubled));
    return GapSensitivity{compliances_t[0], change};
  } catch (const statics::OutOfMemory&) {
    throw;
  } catch (const std::runtime_error& error) {  // InputError or RunError
    observer.warn(fmt::format("compaction {}: with glue.max_gap_mm = {} or {} the panel cannot be tested: {}",
                              compaction, gap / 2, gap * 2, error.what()));
    return std::nullopt;
  }
}

TestedState without_moduli(double compaction, const NotTestable& why, Observer& observer) {
  TestedState state;
  state.compaction = compaction;
  state.not_testable = why;
  state.result.warnings.push_back("This panel cannot be tested: " + why.reason);
  observer.warn(fmt::format("compaction {}: this panel cannot be tested: {}", compaction, why.reason));
  return state;
}

void tell(const TestedState& state, std::size_t kinds, Observer& observer) {
  const auto& result = state.result;
  for (const auto& warning : result.warnings)
    observer.warn(fmt::format("compaction {}: {}", state.compaction, warning));
  if (result.floating_strands > 0) {
    observer.say(fmt::format("test: compaction {}: {} of {} strands are not glued to both loaded ends and are left out",
                             state.compaction, result.floating_strands, result.strands));
  }
  for (std::size_t i = 0; i < std::min(result.moduli.size(), kinds); ++i) {
    const auto& m = result.moduli[i];
    const auto shear_free =
        m.shear_free_modulus_MPa ? fmt::format(" ({:.0f} without shear)", *m.shear_free_modulus_MPa) : "";
    observer.say(fmt::format("test: compaction {}, {}, 1/D_t = {:.4g}: {:.0f} MPa{}", state.compaction,
                             vtest::name(m.kind), m.compliance_t_mm_per_MPa, m.modulus_MPa, shear_free));
  }
}

TestedState measured(const cases::Case& c, const Panel<2>& panel, double compaction, Observer& observer) {
  TestedState state;
  state.compaction = compaction;
  try {
    state.result = vtest::measure(panel, c.test, [&observer] { stop_if_cancelled(observer); });
  } catch (const InputError& error) {
    return without_moduli(compaction, {error.what(), false}, observer);
  } catch (const statics::OutOfMemory&) {
    throw;  // nothing of the panel's: with more memory the run goes on from here
  } catch (const RunError& error) {
    return without_moduli(compaction, {error.what(), true}, observer);
  }
  tell(state, c.test.kinds.size(), observer);
  return state;
}

}  // namespace

TestedState test(const cases::Case& c, const Panel<2>& panel, double compaction, Observer& observer) {
  const auto begin = std::chrono::steady_clock::now();
  auto state = measured(c, panel, compaction, observer);
  state.wall_s = seconds_since(begin);
  if (!state.not_testable) state.gap_sensitivity = gap_sensitivity(panel, c.test, compaction, observer);
  return state;
}

Tested test(const Formed& formed, const std::vector<Panel<2>>& panels, Observer& observer) {
  const auto& c = formed.c;
  Tested tested;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    tell_progress(c, i, observer);
    tested.push_back(test(c, panels[i], c.schedule.compactions[i], observer));
  }
  refuse_if_none_is_testable(tested);
  return tested;
}

void tell_progress(const cases::Case& c, std::size_t index, Observer& observer) {
  const auto& compactions = c.schedule.compactions;
  observer.progress({"test", static_cast<double>(index) / static_cast<double>(compactions.size()),
                     fmt::format("compaction {}", compactions[index])});
}

void refuse_if_none_is_testable(const Tested& tested) {
  const bool any = std::any_of(tested.begin(), tested.end(), [](const auto& state) { return !state.not_testable; });
  if (any || tested.empty()) return;
  const auto& last = tested.back();
  const auto message =
      fmt::format("no panel can be tested; at compaction {}: {}", last.compaction, last.not_testable->reason);
  if (last.not_testable->failed) throw RunError(message);
  throw InputError(message);
}

std::vector<report::PanelModulus> moduli_of(const Formed& formed, const Tested& tested) {
  std::vector<report::PanelModulus> moduli;
  for (const auto& state : tested) {
    const double density = cases::density_kg_m3(formed.c, formed.mat, state.compaction);
    for (const auto& m : state.result.moduli) {
      moduli.push_back({state.compaction, vtest::name(m.kind), m.compliance_t_mm_per_MPa, m.modulus_MPa,
                        m.reaction_modulus_MPa, m.shear_free_modulus_MPa, density});
    }
  }
  return moduli;
}

std::vector<report::Finding> findings_of(const Formed& formed, const Tested& tested) {
  std::vector<report::TestedState> states;
  for (const auto& state : tested) {
    states.push_back({state.compaction, !state.not_testable, state.result.floating_strands, state.result.glued_fraction,
                      state.result.warnings});
  }
  auto findings = report::test_findings(states);
  const auto moduli = moduli_of(formed, tested);
  const auto theory = report::theory_moduli(theory_rows(formed.c, formed.mat), moduli, formed.c.off_axis);
  for (auto& finding : report::stiffness_findings(
           moduli, theory, [&](double compliance_t) { return cases::name_of_glue(formed.c, compliance_t); }))
    findings.push_back(std::move(finding));
  if (const auto remark = remark_on_length(formed)) {
    findings.push_back({report::Level::kNote, fmt::format("Scatter to expect: {}.", *remark), report::About::kBoard, "",
                        "docs/user-guide.md, \"Many panels\""});
  }
  return findings;
}

}  // namespace strandlab::run
