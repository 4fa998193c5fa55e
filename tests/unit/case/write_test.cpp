// Cases as text: round trips, the ready cases of the tree, the reference page, and what identifies a run.
#include "strandlab/case/write.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "samples.hpp"
#include "strandlab/core/error.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::cases {
namespace {

TEST(CaseWrite, ResolvedTextReadsBackToTheSameCase) {
  for (const auto& sample : samples()) {
    const Case c = case_from_text("", "panel.toml", assignments(sample));
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

// "-0" is a whole number in TOML, and reads back as 0.
TEST(CaseWrite, MinusZeroIsZero) {
  const auto c = case_from_text("", "panel.toml", {"kinds.core.angle_deg=-0.0", "press.compactions=[-0.0, 0.4]"});
  const auto text = resolved_text(c);
  EXPECT_EQ(text.find(" -0\n"), std::string::npos);
  EXPECT_EQ(resolved_text(case_from_text(text, "resolved.toml")), text);
}

TEST(CaseWrite, AChangedCaseIsCheckedAsAWhole) {
  auto c = case_from_text("[kinds.core]\nangle_deg = 80\n[press]\ndensities_kg_m3 = [500]\n", "panel.toml");
  c.name = "panel";
  const auto other = changed(c, {"press.compactions=[0, .2]", "run.seed=3"}, "script");
  EXPECT_EQ(other.name, "panel");
  EXPECT_EQ(other.states.compactions, (std::vector<double>{0, 0.2}));
  EXPECT_TRUE(other.states.densities_kg_m3.empty());
  EXPECT_EQ(other.kinds[1].angle_deg, 80);
  EXPECT_EQ(resolved_text(changed(other, {"press.densities_kg_m3=[500]", "run.seed=1"}, "script")), resolved_text(c));
  try {
    changed(c, {"kinds.core.length_mm=1"}, "script");
    FAIL() << "the standard deviation exceeds the mean";
  } catch (const InputError& e) {
    EXPECT_STREQ(std::string(e.what()).substr(0, 33).c_str(), "script: kinds.core.length_sd_mm =");
  }
}

// An override names a material after those of the file; in the resolved file they stand side by side.
TEST(CaseWrite, InstancesStandInTheOrderOfTheirNames) {
  const auto c = case_from_text("[materials.b]\n", "panel.toml",
                                {"materials.a={}", "resins.d={}", "resins.c={}", "kinds.f={}", "kinds.e={}",
                                 "mat.rows=[\"core\", \"e\", \"f\"]"});
  EXPECT_EQ(instances(c, "materials.*"), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(instances(c, "resins.*"), (std::vector<std::string>{"c", "d"}));
  EXPECT_EQ(instances(c, "kinds.*"), (std::vector<std::string>{"surface", "core", "e", "f"}));
  const auto text = resolved_text(c);
  EXPECT_EQ(resolved_text(case_from_text(text, "resolved.toml")), text);
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
  for (const auto* name : {"plywood", "lvl", "le2010_plywood", "le2010_lvl"}) {
    for (const auto& layer : make_mat(ready_case(name)).layers) EXPECT_EQ(layer.strands.size(), 1U) << name;
  }
  EXPECT_THROW(ready_case("osbb"), InputError);
}

// The panels of the dissertation are pressed as it does, the others as a mill would.
TEST(CaseWrite, CasesOfTheDissertationKeepItsLaw) {
  for (const auto& name : ready_cases()) {
    const auto c = ready_case(name);
    if (is_plate(c)) continue;  // of neither
    const bool published = name.find("le2010") == 0 || name.find("rathi") == 0 || name.find("osb_") == 0;
    for (const auto& kind : strand_kinds(c)) {
      EXPECT_EQ(kind.material.law, published ? wood::Law::kHill : wood::Law::kCrushing) << name;
      const bool cold = !published && !presses_hot(c);  // softened where no heat does it
      EXPECT_EQ(kind.yield_factor, !cold ? 1 : kind.name == "surface" ? 0.5 : 0.75) << name;
    }
    EXPECT_EQ(c.states.compactions.empty(), !published) << name;
    EXPECT_EQ(published ? c.states.compactions.back() : c.states.densities_kg_m3.back(), published ? 0.4 : 640) << name;
  }
}

// Rows of Le (2010), 3.6.4: VTC on the surfaces, a core at any angle in Rathi's panels.
TEST(CaseWrite, PanelsWithDensifiedStrandsHaveTheirRows) {
  struct Layers {
    const char* name;
    std::size_t surface, core;
    const char* material;
    double length_mm, spread_deg;
  };
  for (const auto& expected :
       {Layers{"osb_vtc50", 5, 10, "vtc", 150, 0}, Layers{"rathi20_control", 2, 16, "poplar", 150, 90},
        Layers{"rathi20_vtc", 1, 19, "vtc", 125, 90}, Layers{"rathi40_control", 4, 12, "poplar", 150, 90},
        Layers{"rathi40_vtc", 2, 14, "vtc", 125, 90}}) {
    const auto c = ready_case(expected.name);
    const auto rows = layup(c).rows;
    ASSERT_EQ(rows.size(), 2 * expected.surface + expected.core) << expected.name;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const bool surface = i < expected.surface || i >= expected.surface + expected.core;
      EXPECT_EQ(rows[i].kind, surface ? "surface" : "core") << expected.name;
      const double spread_deg = rows[i].angles.value_or(mat::AngleDistribution{}).spread_deg;
      EXPECT_EQ(spread_deg, surface ? 0 : expected.spread_deg) << expected.name;
    }
    EXPECT_EQ(rows.front().statistics.length_mm, expected.length_mm) << expected.name;
    EXPECT_EQ(strand_kinds(c)[0].material.name, expected.material) << expected.name;
    EXPECT_EQ(strand_kinds(c)[1].material.name, "poplar") << expected.name;
  }
}

TEST(CaseWrite, Chapter5CasesVaryLengthAndGap) {
  for (const int length : {75, 150}) {
    for (const int gap : {15, 30}) {
      const auto c = ready_case("osb_length" + std::to_string(length) + "_gap" + std::to_string(gap));
      const auto& s = c.kinds[0].statistics;
      EXPECT_EQ(s.length_mm, length);
      EXPECT_EQ(s.length_sd_mm, 20);
      EXPECT_EQ(s.gap_mm, gap);
      EXPECT_EQ(s.gap_sd_mm, 4.95);
      EXPECT_EQ(c.kinds[1].statistics.length_mm, 25);
      EXPECT_EQ(c.rows, Case().rows);
    }
  }
}

// Two runs give the same bits exactly when no key that changes results differs.
TEST(CaseWrite, HashChangesWithEveryKeyThatChangesResults) {
  std::set<std::string> seen;
  for (const auto& sample : samples()) {
    const auto plain = case_hash(case_from_text("", "panel.toml", sample.base), Step::kTest);
    const auto hash = case_hash(case_from_text("", "panel.toml", assignments(sample)), Step::kTest);
    // A mat that is pressed cold knows nothing of a cycle; [hotpress] makes the pressing hot, unless it says otherwise.
    if (sample.dotted.rfind("hotpress.", 0) == 0 && sample.dotted != "hotpress.mechanics") {
      EXPECT_TRUE(seen.insert(hash).second && hash != plain) << sample.dotted;
      const auto cold =
          case_from_text("", "panel.toml", {sample.dotted + "=" + sample.value, "hotpress.mechanics=column"});
      EXPECT_EQ(case_hash(cold, Step::kTest), plain) << sample.dotted;
    } else if (sample.entry->changes_results) {
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
}  // namespace strandlab::cases
