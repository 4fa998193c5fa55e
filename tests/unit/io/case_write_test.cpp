// Cases as text: round trips, the ready cases of the tree, the reference page, and what identifies a run.
#include "strandlab/io/case_write.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "case_samples.hpp"
#include "strandlab/core/error.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::io {
namespace {

TEST(CaseWrite, ResolvedTextReadsBackToTheSameCase) {
  for (const auto& sample : samples()) {
    const Case c = case_from_text("", "panel.toml", {sample.dotted + "=" + sample.value});
    const Case again = case_from_text(resolved_text(c), "resolved.toml");
    EXPECT_EQ(resolved_text(again), resolved_text(c)) << sample.dotted;
    EXPECT_EQ(to_toml(sample.entry->get(again, sample.name)), sample.value);
  }
}

TEST(CaseWrite, TextsWithQuotesAndControlCharactersReadBack) {
  Case c;
  c.mat_file = "/data/a \"b\\c\"\t\x01.json";
  EXPECT_EQ(case_from_text(resolved_text(c), "resolved.toml").mat_file, c.mat_file);
}

TEST(CaseWrite, CommentedCasesReadBackToTheReadyCases) {
  for (const auto& name : ready_cases()) {
    const auto c = ready_case(name);
    EXPECT_EQ(resolved_text(case_from_text(commented_text(c, ready_case_title(name)), name)), resolved_text(c)) << name;
  }
}

TEST(CaseWrite, CasesOfTheTreeAreTheReadyCases) {
  for (const auto& name : ready_cases()) {
    const auto text = test::contents(std::filesystem::path(STRANDLAB_CASES) / (name + ".toml"));
    EXPECT_TRUE(text == commented_text(ready_case(name), ready_case_title(name)))
        << "to update: strandlab init " << name << " > cases/" << name << ".toml";
  }
}

TEST(CaseWrite, ReferencePageIsUpToDate) {
  const auto text = test::contents(std::filesystem::path(STRANDLAB_CASES) / "../docs/cases.md");
  EXPECT_TRUE(text == reference_text()) << "to update: strandlab init --reference > docs/cases.md";
}

TEST(CaseWrite, ReadyCasesHaveTheirRows) {
  // OSB has 10 core rows across; OSL and LVL none; plywood and LVL have no gaps: one strand per row.
  EXPECT_EQ(layup(ready_case("osl")).rows[10].kind, "surface");
  EXPECT_EQ(make_mat(ready_case("osb")).layers[10].role, "core");
  for (const auto* name : {"plywood", "lvl"}) {
    for (const auto& layer : make_mat(ready_case(name)).layers) EXPECT_EQ(layer.strands.size(), 1U) << name;
  }
  EXPECT_THROW(ready_case("osbb"), InputError);
}

// Two runs give the same bits exactly when no key that changes results differs.
TEST(CaseWrite, HashChangesWithEveryKeyThatChangesResults) {
  std::set<std::string> seen;
  const auto plain = case_hash(Case(), Step::kTest);
  for (const auto& sample : samples()) {
    const auto hash = case_hash(case_from_text("", "panel.toml", {sample.dotted + "=" + sample.value}), Step::kTest);
    if (sample.entry->changes_results) {
      EXPECT_TRUE(seen.insert(hash).second && hash != plain) << sample.dotted;
    } else {
      EXPECT_EQ(hash, plain) << sample.dotted;
    }
  }
}

TEST(CaseWrite, HashOfAStepIgnoresLaterSteps) {
  const Case test = case_from_text("", "panel.toml", {"glue.max_gap_mm=0.2"});
  EXPECT_EQ(case_hash(test, Step::kPress), case_hash(Case(), Step::kPress));
  const Case press = case_from_text("", "panel.toml", {"press.speed_m_s=2"});
  EXPECT_EQ(case_hash(press, Step::kMat), case_hash(Case(), Step::kMat));
  EXPECT_NE(case_hash(press, Step::kPress), case_hash(Case(), Step::kPress));
}

}  // namespace
}  // namespace strandlab::io
