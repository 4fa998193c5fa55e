// What a run's numbers are said to mean: which sentence, at which level, on which side of each limit.
#include "strandlab/report/findings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace strandlab::report {
namespace {

// A pressing whose energies add up: 100 mJ of work, of which 90 are stored or dissipated.
std::vector<press::Record> records(double kinetic_mJ, double friction_mJ) {
  press::Record r;
  r.compaction = 0.2;
  r.platen_work_mJ = 100;
  r.plastic_mJ = 90;
  r.kinetic_mJ = kinetic_mJ;
  r.friction_mJ = friction_mJ;
  r.elastic_mJ = 10 - kinetic_mJ - friction_mJ;
  return {r};
}

Morphology shape(double compaction, double overlap, double strands) {
  Morphology m;
  m.compaction = compaction;
  m.areas.overlap = overlap;
  m.areas.strands = strands;
  return m;
}

// The one finding that holds these words; a note of that when there is none or more.
Finding find(const std::vector<Finding>& list, const std::string& words) {
  std::vector<Finding> found;
  std::copy_if(list.begin(), list.end(), std::back_inserter(found),
               [&](const Finding& f) { return f.text.find(words) != std::string::npos; });
  return found.size() == 1 ? found.front() : Finding{Level::kNote, std::to_string(found.size()) + " of " + words};
}

TEST(Findings, OfAQuietPressing) {
  const auto list = pressing_findings(records(0.99, 2), 0.05, {});
  EXPECT_EQ(find(list, "slow enough").level, Level::kGood);
  EXPECT_NE(find(list, "slow enough").text.find("never held more than 1.0 %"), std::string::npos);  // .99 of 97.01
  EXPECT_EQ(find(list, "add up").text, "The energies add up: all terms together match the platens' work to 0.00 %.");
  EXPECT_NE(find(list, "slid").text.find("friction took 2.0 %"), std::string::npos);
}

// What the strands do before the first kept state is no fault of the press, but shows in the stress.
TEST(Findings, OfMotionBeforeTheFirstKeptState) {
  auto list = records(0.99, 2);
  auto early = list[0];
  early.compaction = 0.11;
  early.kinetic_mJ = 20;
  list.insert(list.begin(), early);
  const auto inertia = find(pressing_findings(list, 0.2, {}), "slow enough");
  EXPECT_EQ(inertia.level, Level::kGood);
  EXPECT_NE(inertia.text.find("from 20 % compaction on the motion of the wood never held more than 1.0 %"),
            std::string::npos)
      << inertia.text;
  EXPECT_NE(inertia.text.find("Up to 11 % it held more"), std::string::npos) << inertia.text;
}

TEST(Findings, OfSoftenedStrandsSayThatTheyStandInForHeat) {
  StrandKind face, core;
  face.name = "face";
  core.name = "core";
  EXPECT_TRUE(softening_findings({face, core}).empty());
  face.yield_factor = 0.5;
  core.stiffness_factor = 0.25;
  const auto text = find(softening_findings({face, core}), "stand in for the heat").text;
  EXPECT_NE(text.find("face 0.5, core 0.25 (stiffness)"), std::string::npos) << text;
}

TEST(Findings, OfEnergiesThatDoNotAddUp) {
  auto list = records(0, 0);
  list[0].plastic_mJ = 88.5;  // 1.5 % of the work is missing, beyond press::kBalanceLimit
  const auto balance = find(pressing_findings(list, 0.05, {}), "energies are off");
  EXPECT_EQ(balance.level, Level::kWarning);
  EXPECT_EQ(balance.text, "The energies are off by 1.5 % of the platens' work (limit 1 %).");
}

// A warning of the press takes the place of the praise that it contradicts.
TEST(Findings, OfAPressThatWarned) {
  const auto list = pressing_findings(records(1, 0), 0.05, {"The press closed too fast."});
  EXPECT_EQ(list.front().level, Level::kWarning);
  EXPECT_EQ(list.front().text, "The press closed too fast.");
  for (const auto& f : list) EXPECT_EQ(f.text.find("slow enough"), std::string::npos);
}

TEST(Findings, OfAMatThatWasNotPressed) {
  ASSERT_EQ(pressing_findings({press::Record{}}, 0.05, {}).size(), 1U);
  EXPECT_EQ(pressing_findings({press::Record{}}, 0.05, {})[0].text, "The mat was not pressed.");
  EXPECT_EQ(pressing_findings({}, 0.05, {})[0].text, "The mat was not pressed.");
}

TEST(Findings, OfOverlapsOnEitherSideOfWhatDrawingExplains) {
  const auto fine = shape_findings({shape(0, 0, 0.8), shape(0.4, 0.9 * kExplainedOverlap, 0.97)});
  EXPECT_EQ(find(fine, "keep apart").level, Level::kGood);
  EXPECT_EQ(find(fine, "Voids").text, "Voids shrank from 20.0 % to 3.9 % of the section.");
  const auto bad = shape_findings({shape(0.1, 1.1 * kExplainedOverlap, 0.9), shape(0.4, 0, 0.97)});
  EXPECT_EQ(find(bad, "overlap").level, Level::kWarning);
  EXPECT_NE(find(bad, "overlap").text.find("at 10 % compaction by 1.1 %"), std::string::npos);
}

// A sentence that several states share but for its numbers is told once; two different ones are told both, and strands
// that the tests leave out are no reason to drop a warning that speaks of wood left out elsewhere.
TEST(Findings, OfTestsTellASharedWarningOnce) {
  TestedState a{0.1, true, 0, 0.8, {"3 of 90 elements were folded over."}};
  TestedState b{0.2, true, 2, 0.9, {"5 of 90 elements were folded over.", "2 whole strands are left out."}};
  const auto list = test_findings({a, b});
  EXPECT_EQ(find(list, "folded over").text,
            "At 20 % compaction: 5 of 90 elements were folded over. (Likewise at 10 %.)");
  EXPECT_EQ(find(list, "whole strands").level, Level::kWarning);
  EXPECT_NE(find(list, "float").text.find("2 at 20 % compaction"), std::string::npos);
  EXPECT_EQ(find(list, "glued.").text, "At 20 % compaction 90 % of the strands' facing length is glued.");
}

TEST(Findings, OfStatesThatCannotBeTestedSayNothingOfTheirGlue) {
  const auto list = test_findings({{0.1, false, 0, 0, {"This panel cannot be tested: no strand reaches."}}});
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0].level, Level::kWarning);
}

// A run of an older program has levels and texts only.
TEST(Findings, OfAnOlderProgramAreAboutTheCalculation) {
  const auto list = findings_from_json(nlohmann::json::parse(R"([{"level":"warning","text":"c"}])"));
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0].level, Level::kWarning);
  EXPECT_EQ(list[0].about, About::kCalculation);
}

TEST(Findings, AsJson) {
  const auto json = to_json({{Level::kGood, "a"}, {Level::kWarning, "c", About::kBoard, "stress", "docs/x.md"}});
  EXPECT_EQ(json.dump(), R"([{"about":"calculation","level":"good","text":"a"},)"
                         R"({"about":"board","chart":"stress","docs":"docs/x.md","level":"warning","text":"c"}])");
  EXPECT_EQ(to_json(findings_from_json(json)), json);
}

}  // namespace
}  // namespace strandlab::report
