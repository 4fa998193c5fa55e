#include "strandlab/report/board_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace strandlab::report {
namespace {

Finding on_board(Level level, std::string text, std::string chart, std::string docs) {
  return {level, std::move(text), About::kBoard, std::move(chart), std::move(docs)};
}

const press::Record& at_highest_stress(const std::vector<press::Record>& records) {
  return *std::max_element(records.begin(), records.end(),
                           [](const auto& a, const auto& b) { return a.stress_MPa < b.stress_MPa; });
}

// One test of one state: moduli by glue, and that of the same laminate laid flat.
struct Stiffness {
  std::vector<double> compliances;
  std::vector<double> moduli;
  std::optional<double> flat;

  std::optional<double> of(double compliance_t) const {
    const auto at = std::find(compliances.begin(), compliances.end(), compliance_t);
    if (at == compliances.end()) return std::nullopt;
    return moduli[static_cast<std::size_t>(at - compliances.begin())];
  }
};

Stiffness stiffness_of(const std::string& test, double compaction, const std::vector<PanelModulus>& moduli,
                       const std::vector<TheoryModulus>& theory) {
  Stiffness s;
  for (const auto& m : moduli) {
    if (m.test != test || m.compaction != compaction) continue;
    s.compliances.push_back(m.compliance_t_mm_per_MPa);
    s.moduli.push_back(m.modulus_MPa);
  }
  for (const auto& m : theory) {
    if (m.test == test && m.compaction == compaction && !depends_on_glue(m.model)) s.flat = m.modulus_MPa;
  }
  return s;
}

// "takes 12 % off", or "adds 3 % to".
std::string change(double from, double to) {
  const double lost = 100 * (1 - to / from);
  return lost >= 0 ? fmt::format("takes {:.0f} % off", lost) : fmt::format("adds {:.0f} % to", -lost);
}

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string lower(std::string text) {
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

}  // namespace

std::string short_label(const std::string& test) {
  const std::string label = vtest::label(vtest::test_from_name(test));
  return label.substr(0, label.find(" ("));
}

double highest_stress_MPa(const std::vector<press::Record>& records) {
  return records.empty() ? 0 : at_highest_stress(records).stress_MPa;
}

std::vector<Finding> pressure_findings(const std::vector<press::Record>& records) {
  if (records.empty() || !(records.back().platen_work_mJ > 0)) return {};
  const auto& worst = at_highest_stress(records);
  const auto words = fmt::format("The platens bear {:.3g} MPa at most", worst.stress_MPa);
  std::vector<Finding> list;
  list.push_back(
      worst.stress_MPa <= kHotPressMPa
          ? on_board(Level::kGood, fmt::format("{}; a mill's hot press gives up to {:g} MPa.", words, kHotPressMPa),
                     "stress", "docs/crushing.md, \"Which law for what\"")
          : on_board(Level::kWarning,
                     fmt::format("{}, beyond the {:g} MPa that a mill's hot press gives: no mill presses to this state "
                                 "as it is pressed here.",
                                 words, kHotPressMPa),
                     "stress", "docs/crushing.md, \"Which law for what\""));
  const double elastic = worst.elastic_mJ / worst.platen_work_mJ;
  list.push_back(on_board(
      Level::kNote,
      fmt::format("At the highest pressure {:.2g} % of the platens' work is stored as in a spring, the rest crushed "
                  "the wood and rubbed strands on one another{}",
                  100 * elastic, elastic > .5 ? ": most of it the panel would give back." : "."),
      "energies", "docs/crushing.md, \"Which law for what\""));
  return list;
}

std::vector<Finding> profile_findings(const std::vector<profile::Profile>& profiles) {
  if (profiles.empty()) return {};
  const auto s = profile::summarise(profiles.back());
  const double contrast = s.surface_over_core() - 1;
  const auto numbers =
      fmt::format("outer quarters {:.0f}, core {:.0f}, densest layers {:.0f} kg/m³, {:.1f} mm below the faces",
                  s.surface, s.core, s.peak, s.peak_depth_mm);
  const char* shape = contrast > kFlatProfile    ? "Dense faces over a light core"
                      : contrast < -kFlatProfile ? "The core is denser than the faces"
                                                 : "The density profile is nearly flat";
  return {on_board(Level::kNote, fmt::format("{}: {}.", shape, numbers), "profile",
                   "docs/user-guide.md, \"Density profile\"")};
}

double middle_glue(const std::vector<double>& compliances_t_mm_per_MPa) {
  std::vector<double> soft;
  for (const double c : compliances_t_mm_per_MPa) {
    if (c > 0) soft.push_back(c);
  }
  std::sort(soft.begin(), soft.end());
  return soft.empty() ? 0 : soft[(soft.size() - 1) / 2];
}

std::vector<Finding> stiffness_findings(const std::vector<PanelModulus>& moduli,
                                        const std::vector<TheoryModulus>& theory,
                                        const std::function<std::string(double)>& name_of_glue) {
  if (moduli.empty()) return {};
  const double compaction = moduli.back().compaction;
  std::vector<std::string> tests;
  for (const auto& m : moduli) {
    if (m.compaction == compaction && std::find(tests.begin(), tests.end(), m.test) == tests.end())
      tests.push_back(m.test);
  }
  std::vector<Finding> list;
  for (const auto& test : tests) {
    const auto s = stiffness_of(test, compaction, moduli, theory);
    const auto perfect = s.of(0);
    if (!perfect) continue;
    const double middle = middle_glue(s.compliances);
    const double softest = *std::max_element(s.compliances.begin(), s.compliances.end());
    const auto chart = "modulus-" + test;
    const auto name = lower(short_label(test));
    if (middle > 0) {
      auto text = fmt::format("Glue ({}) {} the {} modulus of perfect bonds", name_of_glue(middle),
                              change(*perfect, *s.of(middle)), name);
      if (softest > middle)
        text +=
            fmt::format(", the softest ({}) {:.0f} %", name_of_glue(softest), 100 * (1 - *s.of(softest) / *perfect));
      list.push_back(on_board(Level::kNote, text + ".", chart, "docs/user-guide.md, \"Glue\""));
    }
    if (s.flat) {
      list.push_back(on_board(
          Level::kNote,
          capital(fmt::format("undulation, gaps and strand ends: with perfect bonds the {} modulus is {:.0f} % of that "
                              "of the same rows laid flat.",
                              name, 100 * *perfect / *s.flat)),
          chart, "docs/theory.md, \"Closed-form models\""));
    }
  }
  return list;
}

}  // namespace strandlab::report
