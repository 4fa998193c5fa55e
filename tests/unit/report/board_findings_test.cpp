// What numbers say of the board: on which side of a limit, and of which state.
#include "strandlab/report/board_findings.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace strandlab::report {
namespace {

// 100 mJ of work, of which some is elastic, at a stress.
press::Record pressed(double stress_MPa, double elastic_mJ) {
  press::Record r;
  r.stress_MPa = stress_MPa;
  r.elastic_mJ = elastic_mJ;
  r.plastic_mJ = 100 - elastic_mJ;
  r.platen_work_mJ = 100;
  return r;
}

TEST(BoardFindings, PressureIsHeldAgainstAHotPress) {
  const auto fine = pressure_findings({pressed(3.7, 2), pressed(3.1, 1)});
  ASSERT_EQ(fine.size(), 2U);
  EXPECT_EQ(fine[0].level, Level::kGood);
  EXPECT_EQ(fine[0].text, "The platens bear 3.7 MPa at most; a mill's hot press gives up to 6 MPa.");
  EXPECT_NE(fine[1].text.find("2 % of the platens' work"), std::string::npos)
      << "at the highest stress, not at the end";
  const auto hill = pressure_findings({pressed(258, 91)});
  EXPECT_EQ(hill[0].level, Level::kWarning);
  EXPECT_NE(hill[1].text.find("91 % of the platens' work is stored as in a spring"), std::string::npos);
  EXPECT_NE(hill[1].text.find("give back"), std::string::npos);
  EXPECT_TRUE(pressure_findings({}).empty());
  EXPECT_TRUE(pressure_findings({press::Record{}}).empty()) << "a mat that was not pressed bears nothing";
}

// Quarters of 4 bins: outer ones surface, inner ones core.
TEST(BoardFindings, ProfileIsFlatWithinFivePerCent) {
  const auto text = [](double surface, double core) {
    profile::Profile p;
    p.thickness_mm = 8;
    p.density_kg_m3 = {surface, core, core, surface};
    return profile_findings({p}).at(0).text;
  };
  EXPECT_EQ(
      text(700, 600),
      "Dense faces over a light core: outer quarters 700, core 600, densest layers 700 kg/m³, 1.0 mm below the faces.");
  EXPECT_EQ(text(620, 600).rfind("The density profile is nearly flat", 0), 0U);
  EXPECT_EQ(text(500, 600).rfind("The core is denser than the faces", 0), 0U);
}

TEST(BoardFindings, TheMiddleGlueIsOneThatIsNotPerfect) {
  EXPECT_EQ(middle_glue({0, .0021, .0105, .0163, .05}), .0105);
  EXPECT_EQ(middle_glue({.05, 0}), .05);
  EXPECT_EQ(middle_glue({-.001, 0}), 0);
}

// Perfect 8000, PF at 25 % 6000, softest 2000, laid flat 10000 MPa; of the last state, not of the one before.
TEST(BoardFindings, StiffnessSaysWhatGlueAndUndulationCost) {
  std::vector<PanelModulus> moduli{{.1, "tension", 0, 1, 1}, {.1, "tension", .0105, 1, 1}};
  for (const auto& [compliance, modulus] : {std::pair{0.0, 8000.0}, {.0105, 6000.0}, {.05, 2000.0}})
    moduli.push_back({.2, "tension", compliance, modulus, modulus});
  const std::vector<TheoryModulus> theory{{.2, "rule of mixtures", "tension", 0, 10000},
                                          {.2, "shear-lag", "tension", 0, 9000}};
  const auto list = stiffness_findings(moduli, theory);
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].text,
            "Glue (PF 25 %) takes 25 % off the tension modulus of perfect bonds, the softest (1/D_t 0.05) 75 %.");
  EXPECT_EQ(list[1].text,
            "Undulation, gaps and strand ends: with perfect bonds the tension modulus is 80 % of that of the same rows "
            "laid flat.");
  const auto named = stiffness_findings(moduli, theory, [](double) { return std::string("mine"); });
  EXPECT_EQ(named[0].text.rfind("Glue (mine)", 0), 0U);
}

}  // namespace
}  // namespace strandlab::report
