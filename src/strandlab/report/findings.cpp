#include "strandlab/report/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <regex>
#include <string_view>
#include <utility>

namespace strandlab::report {
namespace {

using namespace std::string_view_literals;

constexpr std::array kLevels{"good"sv, "note"sv, "warning"sv};  // in the order of Level
constexpr const char* kSpeedDocs = "docs/user-guide.md, \"The speed of the press\"";

// "12.3 %", or "less than 0.1 %" of what is there but would round to nothing.
std::string percent(double share, int digits = 1) {
  if (share > 0 && 100 * share < 0.5 * std::pow(10.0, -digits))
    return fmt::format("less than {:.{}f} %", std::pow(10.0, -digits), digits);
  return fmt::format("{:.{}f} %", 100 * share, digits);
}

// A compaction or a limit: "40 %", "12.5 %".
std::string rounded(double share) {
  return fmt::format("{:g} %", std::round(1000 * share) / 10 + 0.0);
}

// Where the strands' motion last held more of the energy than the limit; 0: nowhere.
double moved_until(const std::vector<press::Record>& records) {
  double last = 0;
  for (const auto& r : records) {
    if (r.kinetic_mJ > press::kKineticLimit * r.internal_mJ()) last = r.compaction;
  }
  return last;
}

Finding about_inertia(const std::vector<press::Record>& records, double judged_from) {
  double worst = 0;
  for (const auto& r : records) {
    if (r.compaction >= judged_from && r.internal_mJ() > 0) worst = std::max(worst, r.kinetic_mJ / r.internal_mJ());
  }
  if (worst == 0)
    return {
        Level::kGood,
        fmt::format("The pressing ended before {} compaction, where inertia is first judged.", rounded(judged_from)),
        About::kCalculation, "energies", kSpeedDocs};
  const double early = moved_until(records);
  const auto before =
      early > 0 && early < judged_from
          ? fmt::format(" Up to {} it held more: read the pressing stress from there on.", rounded(early))
          : "";
  return {Level::kGood,
          fmt::format("The press was slow enough: from {} compaction on the motion of the wood never held more than {} "
                      "of the energy stored and dissipated in it (limit for the strands' own motion {}), and both "
                      "platens felt the same force within the limit.{}",
                      rounded(judged_from), percent(worst), rounded(press::kKineticLimit), before),
          About::kCalculation, "energies", kSpeedDocs};
}

Finding about_balance(const press::Record& end) {
  const double gap = std::abs(end.balance_error());
  if (gap > press::kBalanceLimit)
    return {Level::kWarning,
            fmt::format("The energies are off by {} of the platens' work (limit {}).", percent(gap),
                        rounded(press::kBalanceLimit)),
            About::kCalculation, "energies", "docs/warnings.md, \"Pressing\""};
  return {Level::kGood,
          fmt::format("The energies add up: all terms together match the platens' work to {}.", percent(gap, 2)),
          About::kCalculation, "energies"};
}

Finding about_friction(const press::Record& end) {
  const double share = end.friction_mJ / end.platen_work_mJ;
  if (share > 1e-4)
    return {Level::kNote,
            fmt::format("Strands slid on one another: friction took {} of the platens' work.", percent(share)),
            About::kCalculation, "energies"};
  return {Level::kNote, "Strands hardly slid on one another: friction took less than 0.01 % of the platens' work.",
          About::kCalculation, "energies"};
}

std::string joined(const std::vector<std::string>& parts) {
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<Finding> shared_warnings(const std::vector<TestedState>& states) {
  static const std::regex number("[0-9.]+");
  std::vector<std::string> order;
  struct Told {
    std::string text;
    std::vector<std::string> at;
  };
  std::map<std::string, Told> told;
  for (const auto& state : states) {
    for (const auto& warning : state.warnings) {
      const auto words = std::regex_replace(warning, number, "#");
      if (told.find(words) == told.end()) order.push_back(words);
      auto& t = told[words];
      const auto also = t.at.empty() ? "" : fmt::format(" (Likewise at {}.)", joined(t.at));
      t.text = fmt::format("At {} compaction: {}{}", rounded(state.compaction), warning, also);
      t.at.push_back(rounded(state.compaction));
    }
  }
  std::vector<Finding> list;
  list.reserve(order.size());
  for (const auto& words : order) list.push_back({Level::kWarning, told[words].text});
  return list;
}

}  // namespace

std::vector<Finding> pressing_findings(const std::vector<press::Record>& records, double judged_from,
                                       const std::vector<std::string>& warnings) {
  if (records.empty() || !(records.back().platen_work_mJ > 0)) return {{Level::kNote, "The mat was not pressed."}};
  std::vector<Finding> list;
  list.reserve(warnings.size() + 3);
  for (const auto& warning : warnings) list.push_back({Level::kWarning, warning});
  if (warnings.empty()) list.push_back(about_inertia(records, judged_from));
  const auto balance = about_balance(records.back());
  if (warnings.empty() || balance.level != Level::kWarning) list.push_back(balance);  // the press has warned of it
  list.push_back(about_friction(records.back()));
  return list;
}

std::vector<Finding> softening_findings(const std::vector<StrandKind>& kinds) {
  std::vector<std::string> softened;
  for (const auto& kind : kinds) {
    if (kind.yield_factor < 1) softened.push_back(fmt::format("{} {:g}", kind.name, kind.yield_factor));
    if (kind.stiffness_factor < 1)
      softened.push_back(fmt::format("{} {:g} (stiffness)", kind.name, kind.stiffness_factor));
  }
  if (softened.empty()) return {};
  return {
      {Level::kNote,
       fmt::format("Pressed cold: softened strands stand in for the heat and moisture of a press (yield_factor of {}). "
                   "The density profile is theirs, not yet that of a press cycle.",
                   joined(softened)),
       About::kBoard, "profile", "docs/crushing.md, \"Softened faces\""}};
}

std::vector<Finding> shape_findings(const std::vector<Morphology>& states) {
  if (states.empty()) return {};
  const auto worst = std::max_element(states.begin(), states.end(),
                                      [](const auto& a, const auto& b) { return a.areas.overlap < b.areas.overlap; });
  const double overlap = worst->areas.overlap;
  std::vector<Finding> list;
  if (overlap > kExplainedOverlap) {
    list.push_back(
        {Level::kWarning, fmt::format("Strands overlap: at {} compaction by {} of the section, more than the {} that "
                                      "drawing strands as straight-edged cells explains.",
                                      rounded(worst->compaction), percent(overlap), rounded(kExplainedOverlap))});
  } else {
    list.push_back({Level::kGood, overlap > 0
                                      ? fmt::format("Strands keep apart: their outlines overlap by {} of the section "
                                                    "at most.",
                                                    percent(overlap, 2))
                                      : "Strands keep apart: nothing overlaps."});
  }
  const double first = states.front().areas.void_fraction(), last = states.back().areas.void_fraction();
  list.push_back({Level::kNote,
                  states.size() > 1
                      ? fmt::format("Voids shrank from {} to {} of the section.", percent(first), percent(last))
                      : fmt::format("Voids take {} of the section.", percent(first)),
                  About::kBoard});
  return list;
}

std::vector<Finding> test_findings(const std::vector<TestedState>& states) {
  auto list = shared_warnings(states);
  std::vector<std::string> floating;
  const TestedState* last = nullptr;
  for (const auto& state : states) {
    if (!state.testable) continue;
    last = &state;
    if (state.floating_strands > 0)
      floating.push_back(fmt::format("{} at {}", state.floating_strands, rounded(state.compaction)));
  }
  if (!last) return list;
  list.push_back(floating.empty() ? Finding{Level::kGood,
                                            "No strand floats: each is glued, directly or through others, to both "
                                            "loaded ends.",
                                            About::kBoard}
                                  : Finding{Level::kNote,
                                            fmt::format("Some strands float: they are glued to nothing that reaches "
                                                        "both loaded ends and were left out of the tests ({} "
                                                        "compaction).",
                                                        joined(floating)),
                                            About::kBoard});
  list.push_back({Level::kNote,
                  fmt::format("At {} compaction {} of the strands' facing length is glued.", rounded(last->compaction),
                              percent(last->glued_fraction, 0)),
                  About::kBoard, "", "docs/user-guide.md, \"Glue\""});
  return list;
}

nlohmann::json to_json(const std::vector<Finding>& findings) {
  auto list = nlohmann::json::array();
  for (const auto& f : findings) {
    nlohmann::json entry{{"level", kLevels[static_cast<std::size_t>(f.level)]},
                         {"text", f.text},
                         {"about", f.about == About::kBoard ? "board" : "calculation"}};
    if (!f.chart.empty()) entry["chart"] = f.chart;
    if (!f.docs.empty()) entry["docs"] = f.docs;
    list.push_back(std::move(entry));
  }
  return list;
}

std::vector<Finding> findings_from_json(const nlohmann::json& list) {
  std::vector<Finding> findings;
  for (const auto& entry : list) {
    const auto level = std::find(kLevels.begin(), kLevels.end(), entry.value("level", ""));
    findings.push_back({level == kLevels.end() ? Level::kNote : static_cast<Level>(level - kLevels.begin()),
                        entry.value("text", ""),
                        entry.value("about", "") == "board" ? About::kBoard : About::kCalculation,
                        entry.value("chart", ""), entry.value("docs", "")});
  }
  return findings;
}

}  // namespace strandlab::report
