// What a run's numbers say, in plain words: for the report's page and run.json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "strandlab/panel/panel.hpp"
#include "strandlab/press/press.hpp"
#include "strandlab/report/morphology.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::report {

enum class Level { kGood, kNote, kWarning };
enum class About { kBoard, kCalculation };

struct Finding {
  Level level = Level::kNote;
  std::string text;
  About about = About::kCalculation;
  std::string chart{};  // of the page, that shows it; empty: none
  std::string docs{};   // the paragraph that explains it; empty: none
};

// Of a pressing whose inertia is judged from a compaction on (press::judged_from()): the press's own warnings, inertia,
// the energy balance, friction.
std::vector<Finding> pressing_findings(const std::vector<press::Record>& records, double judged_from,
                                       const std::vector<std::string>& warnings);

// That softened kinds stand in for heat; nothing where no kind is softened.
std::vector<Finding> softening_findings(const std::vector<StrandKind>& kinds);

// Of the shapes of the states kept: overlaps of strands, voids.
std::vector<Finding> shape_findings(const std::vector<Morphology>& states);

// What the virtual tests found out about the panel at one compaction, beside its moduli.
struct TestedState {
  double compaction = 0;
  bool testable = true;
  int floating_strands = 0;   // left out of the tests
  double glued_fraction = 0;  // of the facing length
  std::vector<std::string> warnings{};
};
// A warning that several states share but for its numbers is told once, as the last of them has it.
std::vector<Finding> test_findings(const std::vector<TestedState>& states);

// [{"level": "good" | "note" | "warning", "text", "about": "board" | "calculation", "chart", "docs"}...], in the order
// given; chart and docs where there are any.
nlohmann::json to_json(const std::vector<Finding>& findings);
// The same back; what an older program left out is about the calculation.
std::vector<Finding> findings_from_json(const nlohmann::json& list);

}  // namespace strandlab::report
