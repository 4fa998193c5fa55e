// Case files: what is read, and the one message that answers each kind of bad input.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "samples.hpp"
#include "strandlab/case/estimate.hpp"
#include "strandlab/case/keys.hpp"
#include "strandlab/case/write.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/input_errors.hpp"
#include "strandlab/core/text.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::cases {
namespace {

using test::message_of;
using test::put;
using test::TemporaryFolder;

std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return message_of<InputError>([&] { case_from_text(text, "panel.toml", overrides); });
}

// Numbers as people type them at a shell: .2 is not TOML but is no other value either.
TEST(CaseRead, OverridesTakeNumbersWithoutALeadingZero) {
  const auto c = case_from_text("", "panel.toml", {"press.compactions=[0, .2,.35]", "kinds.core.angle_deg=-.5"});
  EXPECT_EQ(c.states.compactions, (std::vector<double>{0, 0.2, 0.35}));
  EXPECT_EQ(c.kinds[1].angle_deg, -0.5);
}

TEST(CaseRead, DefaultsAreTheMainJob) {
  const Case c = case_from_text("", "panel.toml");
  const auto rows = layup(c).rows;
  ASSERT_EQ(rows.size(), 20U);
  // Bottom and top quarters are surface rows: 150 +- 20 mm, gaps 15 +- 4.95; the middle half 25 +- 3, gaps 10 +- 1.
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool surface = i < 5 || i >= 15;
    EXPECT_EQ(rows[i].kind, surface ? "surface" : "core");
    EXPECT_EQ(rows[i].statistics.length_mm, surface ? 150 : 25);
    EXPECT_EQ(rows[i].statistics.gap_sd_mm, surface ? 4.95 : 1);
  }
  EXPECT_EQ(c.schedule.speed_m_s, 16);
  EXPECT_EQ(c.states.densities_kg_m3, (std::vector<double>{400, 480, 560, 640}));
  EXPECT_EQ(strand_kinds(c)[0].material.law, wood::Law::kCrushing);
  EXPECT_EQ(c.test.compliance_t_mm_per_MPa, (std::vector<double>{0, 0.0021, 0.0105, 0.0163, 0.05}));
  EXPECT_EQ(strand_kinds(c)[1].angle_deg, 90);
}

bool measures_states(const Key& key) {
  return key.path == "press.densities_kg_m3" || key.path == "press.thicknesses_mm" || key.path == "press.compactions";
}

// Every key can be set in a file and reads back, so no key of the table is dead or bound to another's member.
TEST(CaseRead, EveryKeyIsStored) {
  for (const auto& sample : samples()) {
    const Case c = case_from_text(sample.section + "\n" + sample.key + " = " + sample.value, "panel.toml", sample.base);
    EXPECT_EQ(to_toml(sample.entry->get(c, sample.name)), sample.value) << sample.entry->path;
    const Case overridden = case_from_text("", "panel.toml", assignments(sample));
    EXPECT_EQ(to_toml(sample.entry->get(overridden, sample.name)), sample.value) << sample.entry->path;
    const auto own_name = name_of(*sample.entry);
    if (own_name == "base" || own_name == "species") continue;  // they set the constants
    for (const auto& other : keys()) {                          // and nothing else has changed
      if (&other == sample.entry || section_of(other) != section_of(*sample.entry)) continue;
      if (measures_states(*sample.entry) && measures_states(other))
        continue;  // one of the three takes the place of the others
      EXPECT_EQ(to_toml(other.get(c, sample.name)), to_toml(other.get(plain_case(sample), sample.name)))
          << sample.entry->path << " changes " << other.path;
    }
  }
}

TEST(CaseRead, LaterOverridesWin) {
  const Case c = case_from_text("[press]\nspeed_m_s = 4", "panel.toml", {"press.speed_m_s=8", "press.speed_m_s=2"});
  EXPECT_EQ(c.schedule.speed_m_s, 2);
}

// Full rows of poplar, 350 kg/m3, 16 mm: C = 1 - 350/rho and 1 - t/16, to 1e-4.
TEST(CaseRead, StatesAreSolvedForTheWeightOfTheMat) {
  const std::string full =
      "[kinds.surface]\nlength_mm=0\nlength_sd_mm=0\ngap_mm=0\ngap_sd_mm=0\n"
      "[kinds.core]\nlength_mm=0\nlength_sd_mm=0\ngap_mm=0\ngap_sd_mm=0\n[press]\n";
  const auto solved = [&](const std::string& states) {
    Case c = case_from_text(full + states, "panel.toml");
    settle_states(c, make_mat(c));
    return c.schedule.compactions;
  };
  EXPECT_EQ(solved("densities_kg_m3 = [350, 500, 640]"), (std::vector<double>{0, 0.3, 0.4531}));
  EXPECT_EQ(solved("thicknesses_mm = [16, 12, 8.5]"), (std::vector<double>{0, 0.25, 0.4688}));
  EXPECT_EQ(solved("compactions = [0, 0.123456]"), (std::vector<double>{0, 0.123456}));
}

// A random mat has its own weight: each seed's panel has the density asked for, within what 1e-4 of compaction makes of
// it, 640/(1 - C) 5e-5 = .07 kg/m3.
TEST(CaseRead, EverySeedReachesTheDensityAskedFor) {
  std::set<double> compactions;
  for (const auto* seed : {"1", "2", "3"}) {
    Case c = case_from_text("", "panel.toml", {std::string("run.seed=") + seed, "mat.length_mm=30"});
    const auto mat = make_mat(c);
    settle_states(c, mat);
    EXPECT_NEAR(density_kg_m3(c, mat, c.schedule.compactions.back()), 640, 0.1) << seed;
    EXPECT_NEAR(density_kg_m3(c, mat, c.schedule.compactions.front()), 400, 0.1) << seed;
    compactions.insert(c.schedule.compactions.back());
  }
  EXPECT_EQ(compactions.size(), 3U);
}

// One measure of the states counts: --set takes the place of the file's, and two beside each other are refused.
TEST(CaseRead, StatesHaveOneMeasure) {
  const auto c =
      case_from_text("[press]\ndensities_kg_m3 = [500, 640]", "panel.toml", {"press.thicknesses_mm=[12, 9]"});
  EXPECT_EQ(c.states.thicknesses_mm, (std::vector<double>{12, 9}));
  EXPECT_TRUE(c.states.densities_kg_m3.empty() && c.states.compactions.empty());
  for (const auto& [text, overrides] :
       {std::pair{std::string("[press]\ncompactions = [0]\ndensities_kg_m3 = [640]"), std::vector<std::string>{}},
        std::pair{std::string(), std::vector<std::string>{"press.compactions=[0]", "press.densities_kg_m3=[640]"}}}) {
    const auto message = refusal(text, overrides);
    for (const auto* part : {"press.compactions", "press.densities_kg_m3", "contradict each other", "give one of"})
      EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST(CaseRead, StatesBeyondTheMatAreRefused) {
  const auto refused = [](const std::string& states) {
    return message_of<InputError>([&] {
      auto c = case_from_text("[mat]\nrows = [\"surface*20\"]\n[press]\n" + states, "panel.toml");
      settle_states(c, make_mat(c));
    });
  };
  struct {
    const char* states;
    const char* part;
  } const cases[] = {
      {"densities_kg_m3 = [200, 640]", "[200, 640] kg/m3: entry 1, 200 kg/m3, is below the mat as formed"},
      {"thicknesses_mm = [17, 10]", "entry 1, 17 mm, is above the mat as formed, which has 16 mm"},
      {"thicknesses_mm = [10, 1e-5]", "entry 2, 1e-05 mm, leaves nothing of the mat"},
      {"densities_kg_m3 = [640, 640.001]", "entry 2, 640.001 kg/m3, is the same state"}};
  for (const auto& c : cases) {
    const auto message = refused(c.states);
    EXPECT_NE(message.find("panel.toml:4: press."), std::string::npos) << message;
    EXPECT_NE(message.find(c.part), std::string::npos) << message;
  }
}

TEST(CaseRead, BareWordsAreTexts) {
  const Case c = case_from_text(
      "", "panel.toml", {"press.sides=free", "test.kinds=[tension, bending_end_couple]", "mat.file=/data/a.json"});
  EXPECT_EQ(c.sides, mpm::Side::kFree);
  EXPECT_EQ(c.test.kinds, (std::vector{vtest::TestKind::kTension, vtest::TestKind::kBendingEndCouple}));
  EXPECT_EQ(c.mat_file, "/data/a.json");
}

TEST(CaseRead, MatFileCountsFromTheCaseFile) {
  const TemporaryFolder folder;
  put(folder / "panel.toml", "[mat]\nfile = \"mats/a.json\"");
  EXPECT_EQ(read_case(folder / "panel.toml").mat_file, (folder.path() / "mats/a.json").string());
  EXPECT_EQ(read_case(folder / "panel.toml", {"mat.file=b.json"}).mat_file,
            (std::filesystem::current_path() / "b.json").string());
  EXPECT_EQ(read_case(folder / "panel.toml").name, "panel");
}

TEST(CaseRead, MaterialsStartFromTheirBase) {
  const Case c = case_from_text(
      "[kinds.surface]\nmaterial=\"mine\"\n[materials.mine]\nE_L_MPa = 20000\nbase = \"vtc\"\n", "panel.toml");
  const auto material = strand_kinds(c)[0].material;
  EXPECT_EQ(material.name, "mine");
  EXPECT_EQ(material.E_L, 20000);
  EXPECT_EQ(material.density_kg_m3, 910);  // of vtc, although base comes last
}

// In whatever order they stand: a material has all that those have on which it builds.
TEST(CaseRead, MaterialsBuildOnOthersOfTheCase) {
  const std::string text =
      "[materials.a_wet]\nbase = \"b_dry\"\nE_R_MPa = 400\n"
      "[materials.b_dry]\nE_L_MPa = 13000\nspecies = \"douglas-fir\"\ndensity_kg_m3 = 480\nbase = \"c_own\"\n"
      "[materials.c_own]\ncrushing_Y_R_MPa = 3.5\n";
  const Case c = case_from_text(text, "panel.toml");
  const auto wet = c.materials[0].material;
  EXPECT_EQ(wet.name, "a_wet");
  EXPECT_EQ(wet.E_R, 400);
  EXPECT_EQ(wet.E_L, 13000);
  EXPECT_EQ(wet.density_kg_m3, 480);
  EXPECT_DOUBLE_EQ(wet.E_T, 650);  // .050 E_L of b_dry's species
  EXPECT_EQ(wet.crushing.Y_R, 3.5);
  const auto again = case_from_text(resolved_text(c), "resolved.toml").materials;
  ASSERT_EQ(again.size(), 3U);
  EXPECT_EQ(again[0].base, "b_dry");
  EXPECT_EQ(again[0].material.E_T, wet.E_T);
  EXPECT_EQ(
      case_from_text(text, "panel.toml", {"materials.c_own.crushing_Y_R_MPa=4"}).materials[0].material.crushing.Y_R, 4);
  EXPECT_EQ(refusal("[materials.a]\nbase = \"b\"\n[materials.b]\nbase = \"a\"\n"),
            "panel.toml:2: materials.a.base = \"b\": the material builds on itself (a on b on a)");
  EXPECT_EQ(refusal("[materials.a]\nbase = \"a\"\n"),
            "panel.toml:2: materials.a.base = \"a\": the material builds on itself (a on a)");
  EXPECT_EQ(refusal("[materials.x]\nbase = \"a\"\n[materials.a]\nbase = \"b\"\n[materials.b]\nbase = \"a\"\n"),
            "panel.toml:4: materials.a.base = \"b\": the material builds on itself (a on b on a)");
}

// Wherever they stand in the file: E_L and species first, then what is given besides.
TEST(CaseRead, MaterialsFollowFromTheirSpecies) {
  const Case c = case_from_text(
      "[materials.mine]\nE_R_MPa = 1000\nspecies = \"douglas-fir\"\nE_L_MPa = 12000\ndensity_kg_m3 = 480\n",
      "panel.toml");
  const auto& m = c.materials[0].material;
  EXPECT_EQ(m.E_L, 12000);
  EXPECT_EQ(m.E_R, 1000);
  EXPECT_EQ(m.density_kg_m3, 480);
  EXPECT_DOUBLE_EQ(m.E_T, 600);  // .050 E_L
  EXPECT_DOUBLE_EQ(m.G_RT, 84);  // .007 E_L
  EXPECT_EQ(m.hill.Y_R, 5);      // of poplar, the base
  const auto told = derived_constants(c);
  ASSERT_EQ(told.size(), 1U);
  for (const auto* part : {"material mine: E_T, G_RL,", "E_L = 12000 MPa", "douglas-fir", "Wood Handbook"})
    EXPECT_NE(told[0].find(part), std::string::npos) << told[0];
  EXPECT_EQ(told[0].find("E_R"), std::string::npos) << told[0];
  EXPECT_TRUE(derived_constants(Case()).empty());
}

// E_L alone, without a species, moves no other constant: that is said, and not of a material that keeps E_L.
TEST(CaseRead, ConstantsThatDoNotFollowAreTold) {
  const Case c = case_from_text(
      "[materials.mine]\nE_L_MPa = 20000\nG_RT_MPa = 90\n[materials.heavy]\ndensity_kg_m3 = 500\n", "panel.toml");
  EXPECT_EQ(c.materials[0].material.E_R, 914);
  const auto told = derived_constants(c);
  ASSERT_EQ(told.size(), 1U);
  for (const auto* part : {"material mine: E_R, E_T,", "are those of poplar as they stand", "9936 MPa", "20000 MPa"})
    EXPECT_NE(told[0].find(part), std::string::npos) << told[0];
  EXPECT_EQ(told[0].find("G_RT"), std::string::npos) << told[0];
}

// A row has the thickness of its kind, the case's where the kind has none.
TEST(CaseRead, KindsMayDifferInThicknessAndAngles) {
  Case c = case_from_text(
      "[mat]\nlength_mm = 40\nrows = [\"surface\", \"core\"]\nlayer_thickness_mm = 0.7\n"
      "[kinds.surface]\nthickness_mm = 1.4\n[kinds.core]\nangle_deg = 10\nangle_spread_deg = 5\n",
      "panel.toml");
  const auto mat = make_mat(c);
  EXPECT_EQ(mat.thickness_of(0), 1.4);
  EXPECT_EQ(mat.thickness_of(1), .7);
  EXPECT_FALSE(mat.layers[0].strands[0].angle_deg);
  for (const auto& strand : mat.layers[1].strands) EXPECT_NEAR(strand.angle_deg.value(), 10, 5);
  const auto normal = make_mat(changed(c, {"kinds.core.angle_spread_deg=0", "kinds.core.angle_sd_deg=25"}, "panel"));
  for (std::size_t i = 0; i < normal.layers[1].strands.size(); ++i) {
    EXPECT_EQ(normal.layers[1].strands[i].x0_mm, mat.layers[1].strands[i].x0_mm);
    EXPECT_NE(normal.layers[1].strands[i].angle_deg, mat.layers[1].strands[i].angle_deg);
  }
  settle_states(c, mat);
  const auto panel = make_panel(c, mat);
  EXPECT_DOUBLE_EQ(panel.initial_thickness_mm, 2.1);
  EXPECT_EQ(panel.strands.front().lattice.counts[1], 12);  // twice the thickness of the core's
  EXPECT_EQ(panel.strands.back().lattice.counts[1], 6);
  const auto e = estimate(c, panel);
  EXPECT_DOUBLE_EQ(e.cell_height_mm, .7 / 3);
  EXPECT_NEAR(static_cast<double>(e.particles) / particle_count(c, mat), 1, .02);
}

TEST(CaseRead, RunsTheRowsOfAMatFileWithOwnKinds) {
  const Case c =
      case_from_text("[mat]\nrows = [\"face\", \"core*3\", \"face\"]\n[kinds.face]\nlength_mm = 125\n", "panel.toml");
  const auto rows = layup(c).rows;
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_EQ(rows[4].kind, "face");
  EXPECT_EQ(rows[4].statistics.length_mm, 125);
}

struct Bad {
  std::string text;
  std::vector<std::string> said;  // parts of the message
};

TEST(CaseRead, BadInputIsAnsweredByFileLineKeyGivenAndAllowed) {
  const std::vector<Bad> table{
      {"[press]\nsped_m_s = 3",
       {"panel.toml:2", "unknown key press.sped_m_s", "did you mean speed_m_s?", "compactions"}},
      {"speed_m_s = 3", {"panel.toml:1", "did you mean press.speed_m_s?"}},
      {"[mat]\nspeed_m_s = 3", {"panel.toml:2", "did you mean press.speed_m_s?", "layer_thickness_mm"}},
      {"[pres]\nspeed_m_s = 3", {"panel.toml:1", "unknown section [pres]", "did you mean press?", "kinds, materials"}},
      {"press = 3", {"panel.toml:1", "press is a section"}},
      {"[[press]]\nspeed_m_s = 3", {"panel.toml:1", "press is a section"}},
      {"[press]\nspeed_m_s = \"fast\"",
       {"panel.toml:2", "press.speed_m_s = \"fast\" m/s", "must be a number, this is a text"}},
      {"[press]\nsymmetric = 1", {"must be true or false, this is a whole number"}},
      {"[press]\ncompactions = 0.4", {"must be a list of numbers, this is a number"}},
      {"[press]\ncompactions = [0, \"a\"]", {"must be a list of numbers"}},
      {"[press]\nspeed_m_s = nan", {"press.speed_m_s = nan", "greater than 0"}},
      {"[run]\nseed = 1.5", {"must be a whole number"}},
      {"[run]\nseed = -1", {"run.seed = -1"}},
      {"[mat]\nlength_mm = -100", {"panel.toml:2", "mat.length_mm = -100 mm", "from 0.001 to 100000"}},
      {"[mat]\nlayer_thickness_mm = 0", {"panel.toml:2", "mat.layer_thickness_mm = 0 mm", "from 0.001 to 1000000000"}},
      {"[materials.m]\ndensity_kg_m3 = 0", {"panel.toml:2", "materials.m.density_kg_m3 = 0 kg/m3", "greater than 0"}},
      {"[materials.m]\nE_R_MPa = -914", {"panel.toml:2", "materials.m.E_R_MPa = -914 MPa", "greater than 0"}},
      {"[materials.m]\nG_RT_MPa = 0", {"panel.toml:2", "materials.m.G_RT_MPa = 0 MPa"}},
      {"[kinds.surface]\nlength_sd_mm = 151", {"panel.toml:2", "kinds.surface.length_sd_mm = 151", "length_mm = 150"}},
      {"[kinds.core]\ngap_mm = 0.5", {"panel.toml:2", "kinds.core.gap_sd_mm = 1", "gap_mm = 0.5"}},
      {"[kinds.core]\nlength_mm = 0\nlength_sd_mm = 0", {"kinds.core.length_mm", "must be 0 too, not 0, 10 and 1"}},
      {"[kinds.surface]\nlength_mm = 0",
       {"panel.toml:2: kinds.surface.length_mm = 0 means that one strand fills the row", "not 20, 15 and 4.95"}},
      {"[kinds.core]\nlength_mm = 0\nlength_sd_mm = 0\ngap_mm = 0", {"kinds.core.length_mm", "not 0, 0 and 1"}},
      {"[kinds.core]\nwidth_sd_mm = 3", {"panel.toml:2", "kinds.core.width_sd_mm = 3 mm", "width_mm = 0"}},
      {"[kinds.core]\nlength_mm = 0\nlength_sd_mm = 0\ngap_mm = 0\ngap_sd_mm = 0\nwidth_mm = 20",
       {"panel.toml:6: kinds.core.width_mm = 20 mm", "one strand fills the row", "leave it out"}},
      {"[press]\ncompactions = [0, 1]", {"panel.toml:2", "press.compactions = [0, 1]", "less than 1"}},
      {"[press]\ncompactions = [0.2, 0.1]", {"press.compactions = [0.2, 0.1]", "increasing"}},
      {"[press]\ncompactions = [0.2, 0.2]", {"increasing"}},
      {"[press]\ncompactions = [-0.1, 0.2]", {"from 0"}},
      {"[press]\ncompactions = []", {"must not be empty"}},
      {"[press]\ncompactions = [0, 40]", {"entry 2, 40, must be from 0 to less than 1", "as 0.4 for 40 %"}},
      {"[press]\ncompactions = [0, 0,4]", {"entry 3, 4, must be from 0 to less than 1", "decimal point"}},
      {"[kinds.core]\nyield_factor = 75", {"and at most 1", "fraction"}},
      {"[press]\ndensities_kg_m3 = [640, 500]", {"press.densities_kg_m3 = [640, 500] kg/m3", "increasing"}},
      {"[press]\ndensities_kg_m3 = [640, 1500]", {"entry 2, 1500, must be greater than 0 to less than 1500"}},
      {"[press]\nthicknesses_mm = [8, 12]", {"entry 2, 12, is not below entry 1, 8, ", "decreasing"}},
      {"[press]\nsides = \"rollers\"", {"panel.toml:2", "\"rollers\"", "one of roller, free", "did you mean roller?"}},
      {"[test]\nkinds = [\"tensions\"]",
       {"one of tension, bending_end_rotation, bending_end_couple", "did you mean tension?"}},
      {"[kinds.core]\nlaw = \"crushin\"",
       {"panel.toml:2", "kinds.core.law = \"crushin\"", "one of hill, crushing", "did you mean crushing?"}},
      {"[kinds.surfce]\nlaw = \"crushing\"",
       {"panel.toml:2", "[kinds.surfce]", "no row in mat.rows is of this kind", "did you mean surface?"}},
      {"[mat]\noffaxis = \"exac\"", {"panel.toml:2", "one of exact, uncoupled", "did you mean exact?"}},
      {"[materials.m]\ncrushing_c = 1.5", {"panel.toml:2", "materials.m.crushing_c = 1.5", "from -1 to 1"}},
      {"[materials.m]\ndensity_kg_m3 = 1600\n[kinds.core]\nmaterial = \"m\"\nlaw = \"crushing\"",
       {"panel.toml:5", "[kinds.core]", "material \"m\"", "density_kg_m3 = 1600", "nothing to crush", "1500"}},
      {"[kinds.core]\nmaterial = \"popla\"", {"one of poplar, vtc", "did you mean poplar?"}},
      {"[kinds.core]\nthickness_mm = -1", {"panel.toml:2", "kinds.core.thickness_mm = -1 mm", "0, or from 0.001 to"}},
      {"[kinds.core]\nangle_spread_deg = 100", {"kinds.core.angle_spread_deg = 100 degrees", "from 0 to 90"}},
      {"[kinds.core]\nangle_sd_deg = 91", {"kinds.core.angle_sd_deg = 91 degrees", "from 0 to 90"}},
      {"[kinds.core]\nangle_sd_deg = 25\nangle_spread_deg = 10",
       {"panel.toml:2: kinds.core.angle_sd_deg = 25", "angle_spread_deg = 10:", "give one of these keys"}},
      {"[mat]\nforming = \"draped\"", {"panel.toml:2: mat.forming belongs to the case of a plate (3D)"}},
      {"[mat]\nwidth_mm = 254\nlength_mm = 254\n[kinds.core]\nlength_mm = 25\ngap_mm = 10",
       {"panel.toml:6: kinds.core.gap_mm", "25 mm, its width, of a core strand", "leave out gap_mm"}},
      {"[mat]\nwidth_mm = 60", {"panel.toml:2", "meets its own image in a window of 100 x 60 mm"}},
      {"[kinds.core]\nyield_factor = 0", {"kinds.core.yield_factor = 0", "greater than 0 and at most 1"}},
      {"[kinds.core]\nstiffness_factor = 2", {"kinds.core.stiffness_factor = 2", "greater than 0 and at most 1"}},
      {"[materials.m]\nspecies = \"douglas fir\"",
       {"panel.toml:2", "materials.m.species", "yellow-poplar", "did you mean douglas-fir?"}},
      {"[materials.m]\nspecies = \"Quaking aspen\"", {"panel.toml:2", "have no aspen", "yellow-poplar stands in"}},
      // |nu_TR| must stay below sqrt(E_T/E_R) = .68 for the R-T block of the compliance to be positive definite.
      {"[materials.m]\nnu_TR = 0.7", {"panel.toml:2", "[materials.m]", "not positive definite", "nu_TR"}},
      {"[materials.m]\nY_R_MPa = 6", {"panel.toml:2", "[materials.m]", "not positive semi-definite", "Y_R"}},
      {"[materials.poplar]\nE_L_MPa = 1", {"panel.toml:1", "built-in material"}},
      {"[kinds.\"a b\"]\nangle_deg = 0", {"panel.toml:1", "letters, digits"}},
      {"[mat]\nrows = [\"surfac*5\"]", {"panel.toml:2", "mat.rows", "did you mean \"surface\"?"}},
      {"[mat]\nrows = [\"core*0\"]", {"mat.rows", "core*10"}},
      {"[mat]\nrows = [\"core*2x\"]", {"mat.rows", "core*10"}},
      {"[press]\nspeed_m_s = = 3", {"panel.toml:2", "not valid TOML"}},
      {"[press]\nspeed_m_s = 1\nspeed_m_s = 2", {"panel.toml:3", "not valid TOML"}},
      {"[press]\nspeed_m_s = 2024-01-01", {"must be a number, this is a date or time"}},
  };
  for (const auto& bad : table) {
    const auto message = refusal(bad.text);
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    for (const auto& part : bad.said)
      EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks: " << part;
  }
}

// Each mistake of a file has its line, given and allowed, rules between keys too; keys of a section that is misspelt
// are not told one by one.
TEST(CaseRead, AllMistakesAreToldAtOnce) {
  const std::string text =
      "[mat]\nlenght_mm = 3\nrows = 3\n[pres]\nspeed = 1\n[press]\nfriction = -1\ndensities_kg_m3 = [500]\n"
      "compactions = [0.2]\n";
  try {
    case_from_text(text, "panel.toml", {"grid.courant=x"});
    FAIL() << "no error";
  } catch (const InputErrors& e) {
    ASSERT_EQ(e.messages.size(), 6U) << e.what();
    for (const auto& [i, opening] : {std::pair{0, "panel.toml:2: unknown key mat.lenght_mm; did you mean length_mm?"},
                                     {1, "panel.toml:4: unknown section [pres]; did you mean press?"},
                                     {2, "panel.toml:3: mat.rows = 3: must be a list of texts"},
                                     {3, "panel.toml:7: press.friction = -1: must be from 0 to 10"},
                                     {4, "--set grid.courant=x: grid.courant = \"x\": must be a number"},
                                     {5, "panel.toml:8: press.densities_kg_m3 and press.compactions"}})
      EXPECT_EQ(e.messages[static_cast<std::size_t>(i)].rfind(opening, 0), 0U)
          << e.messages[static_cast<std::size_t>(i)];
  }
  EXPECT_NE(refusal("[press]\ndensities_kg_m3 = [500]\ncompactions = [0.2]").find("contradict"), std::string::npos);
  std::string many = "[mat]\n";
  for (int i = 0; i < 30; ++i) many += "a" + std::to_string(i) + " = 1\n";
  EXPECT_NE(refusal(many).find("... and 10 more"), std::string::npos);
}

std::vector<std::string> all_mistakes(const std::string& text) {
  try {
    case_from_text(text, "panel.toml");
  } catch (const InputErrors& e) {
    return e.messages;
  } catch (const InputError& e) {
    return {e.what()};
  }
  return {};
}

// Rules between keys hold for the parts of a case in which every key is right: of the others they would speak of
// defaults that nobody gave.
TEST(CaseRead, RulesBetweenKeysAreToldInTheSameAnswer) {
  const auto mistakes = all_mistakes(
      "[mat]\nlenght_mm = 3\n"                                       // a key
      "[kinds.core]\ngap_mm = 0.5\n"                                 // less than its standard deviation of 1
      "[kinds.surface]\nlength_mm = \"long\"\nlength_sd_mm = 160\n"  // a key, and so no rule about its length
      "[materials.a]\nnu_TR = 0.7\n"                                 // not positive definite
      "[materials.b]\nnu_TR = 0.7\nE_L_MPa = -1\n"                   // a key, and so no rule
      "[materials.poplar]\nE_L_MPa = 1e4\n");                        // a built-in name
  std::vector<std::string> openings{"panel.toml:2: unknown key mat.lenght_mm",
                                    "panel.toml:13: [materials.poplar]",
                                    "panel.toml:12: materials.b.E_L_MPa = -1",
                                    "panel.toml:6: kinds.surface.length_mm = \"long\" mm: must be a number",
                                    "panel.toml:4: kinds.core.gap_sd_mm = 1 mm: must not exceed",
                                    "panel.toml:9: [materials.a]: material \"a\": compliance is not positive definite"};
  ASSERT_EQ(mistakes.size(), openings.size()) << fmt::format("{}", fmt::join(mistakes, "\n"));
  for (std::size_t i = 0; i < openings.size(); ++i) EXPECT_EQ(mistakes[i].rfind(openings[i], 0), 0U) << mistakes[i];
}

// A width makes lengths those of whole strands, of which a section shows the width where they lie across: the same mat
// as of strands whose width is given as their length.
TEST(CaseRead, StrandsAcrossShowTheirWidth) {
  const auto whole = case_from_text(
      "[kinds.core]\nlength_mm = 150\nlength_sd_mm = 20\nwidth_mm = 25\nwidth_sd_mm = 3\n[kinds.surface]\n"
      "width_mm = 25\n",
      "panel.toml");
  EXPECT_EQ(mat::to_text(make_mat(whole)), mat::to_text(make_mat(Case())));
  EXPECT_EQ(in_section(whole, whole.kinds[1]).length_mm, 25);
  const auto turned = changed(whole, {"kinds.core.angle_sd_deg=25"}, "test");
  EXPECT_GT(in_section(turned, turned.kinds[1]).length_mm, 25);
  EXPECT_TRUE(make_mat(turned).layers[7].strands.front().angle_deg.has_value());
}

// Sizes that no mat is formed of are refused where they are written, by the range that the reference shows.
TEST(CaseRead, SizesOfAMatThatCannotBeFormedAreRefusedWhereTheyStand) {
  for (const auto* key : {"length_mm", "layer_thickness_mm"}) {
    const auto message = refusal(std::string("[mat]\n") + key + " = 1e-4");
    EXPECT_NE(message.find(std::string("panel.toml:2: mat.") + key + " = 0.0001 mm: must be from 0.001 to"),
              std::string::npos)
        << message;
  }
  for (const auto* key : {"thickness_mm", "length_mm"}) {
    const auto message = refusal(std::string("[kinds.core]\n") + key + " = 1e-4");
    EXPECT_NE(message.find("0, or from 0.001 to 1000000000"), std::string::npos) << message;
    EXPECT_NO_THROW(case_from_text(
        std::string("[kinds.core]\nlength_sd_mm = 0\ngap_mm = 0\ngap_sd_mm = 0\n") + key + " = 0", "panel.toml"));
  }
  // What the seed decides is told where the rows are given.
  const Case c = case_from_text(
      "[mat]\nlength_mm = 1\nrows = [\"core\"]\n[kinds.core]\nlength_mm = 1\nlength_sd_mm = 0\ngap_mm = 1e6\n"
      "gap_sd_mm = 0\n",
      "panel.toml");
  const auto message = message_of<InputError>([&] { make_mat(c); });
  EXPECT_NE(message.find("panel.toml:3: mat.rows: layup: row 1"), std::string::npos) << message;
}

TEST(CaseRead, ValuesAreShownAsTheyWereMeant) {
  using namespace std::string_literals;
  const std::vector<Bad> table{
      {"[run]\nseed = 3.0", {"panel.toml:2: run.seed = 3.0: must be a whole number, such as 3", "decimal point"}},
      {"[press]\nspeed_m_s = 1,5", {"panel.toml:2: not valid TOML", "numbers have a decimal point: 1.5"}},
      {"[press]\nspeed_m_s = 1,5  # m/s", {"decimal point: 1.5"}},
      {"[press]\nspeed_m_s = \"1,5\"", {"must be a number, this is a text; numbers have a decimal point: 1.5"}},
      {"[mat]\nfile = \"C:\\Users\\mat.json\"",
       {"panel.toml:2: not valid TOML", "write / in file names, or single quotes"}},
      {"[glue]\nfrom_bondline = \"C:\\dls.json\"", {"panel.toml:2", "single quotes"}},
      {"[press]\ncompactions = [0, nan]", {"press.compactions = [0, nan]: entry 2, nan, must be from 0"}},
      {"[press]\ncompactions = [0, inf]", {"entry 2, inf, must be a finite number"}},
      {"[press]\ncompactions = [0.1, 0.3, 0.2]", {"entry 3, 0.2, is not above entry 2, 0.3, "}},
      {"[press]\ncompactions = [0, \"a\"]", {"must be a list of numbers, entry 2, \"a\", is a text"}},
      {"[glue]\ncompliance_t_mm_per_MPa = [0, 0.1, nan]", {"entry 3, nan, must be a finite number"}},
      {"[test]\nkinds = [\"tension\", 3]", {"must be a list of texts, entry 2, 3, is a whole number"}},
      {"[test]\nkinds = [\"tension\", \"tensions\"]", {"entry 2, \"tensions\" is not one of"}},
      {"\xFF\xFE[\0m\0"s, {"panel.toml: this file is UTF-16; save it as UTF-8"}},
      {"[\0m\0a\0"s, {"panel.toml: this file is UTF-16; save it as UTF-8"}},
      {"[mat]\n\0length_mm = -1"s, {"panel.toml:2: a NUL byte"}},
      {"[mat]\n# gr\xFCn\nlength_mm = 9", {"panel.toml:2: the byte \\xfc is not UTF-8"}},
      {"[run]\nseed = 9000000000000000001", {"run.seed = 9000000000000000001: must be from 0 to 9000000000000000000"}},
  };
  for (const auto& bad : table) {
    const auto message = refusal(bad.text);
    for (const auto& part : bad.said)
      EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks: " << part;
  }
  EXPECT_EQ(case_from_text("\xEF\xBB\xBF[mat]\nlength_mm = 9", "panel.toml").length_mm, 9);
  for (const auto* text : {"press.speed_m_s=1,5", "mat.file=C:\\mats\\a.json", "mat.file=\"C:\\mats\\a.json\""})
    EXPECT_NE(refusal("", {text}).find(text[0] == 'p' ? "decimal point: 1.5" : "single quotes"), std::string::npos)
        << refusal("", {text});
  EXPECT_NE(refusal("", {"press.speed_m_s=1\0 5"s}).find("no text in UTF-8"), std::string::npos);
  EXPECT_NE(refusal("", {"mat.file=f\xFCr.json"}).find("no text in UTF-8"), std::string::npos);
}

// However much comes in, a line goes out.
TEST(CaseRead, LongValuesAreShortenedInMessages) {
  const std::string a_lot(100000, 'x');
  for (const auto& text : {"[press]\nspeed_m_s = \"" + a_lot + "\"", "[press]\nsides = \"" + a_lot + "\"",
                           "[press]\n" + a_lot + " = 1", "[" + a_lot + "]\n", "[kinds." + a_lot + "]\n",
                           "[kinds.\" " + a_lot + "\"]\n", "[mat]\nrows = [\"" + a_lot + "\"]",
                           "[mat]\nrows = [\"core*" + a_lot + "\"]", "[press]\nspeed_m_s = " + a_lot}) {
    const auto message = refusal(text);
    EXPECT_LT(message.size(), 1000U) << text.substr(0, 30);
    EXPECT_NE(message.find("panel.toml:"), std::string::npos);
  }
  EXPECT_LT(refusal("", {"press.speed_m_s=" + a_lot}).size(), 1000U);
  EXPECT_LT(refusal("", {a_lot}).size(), 1000U);
}

// Beyond 2^53 doubles skip whole numbers.
TEST(CaseRead, SeedsAreExactWholeNumbers) {
  const Case one = case_from_text("[run]\nseed = 9007199254740993", "panel.toml");
  const Case other = case_from_text("[run]\nseed = 9007199254740992", "panel.toml");
  EXPECT_EQ(one.seed, 9007199254740993U);
  EXPECT_NE(resolved_text(one).find("seed = 9007199254740993\n"), std::string::npos);
  EXPECT_NE(case_hash(one, Step::kMat), case_hash(other, Step::kMat));
  EXPECT_EQ(case_from_text("[run]\nseed = 9000000000000000000", "panel.toml").seed, 9000000000000000000U);
}

// An old share's folder: the case file written from it is UTF-8 and names two folders by two texts.
TEST(CaseRead, FileNamesThatAreNotUtf8AreWrittenAsText) {
  Case c = case_from_text("", "panel.toml"), other = c;
  c.mat_file = "/f\xFCr/mat.json";
  other.mat_file = "/f\xE4r/mat.json";
  EXPECT_TRUE(is_utf8(resolved_text(c)));
  EXPECT_NE(resolved_text(c).find("f\\\\xfcr"), std::string::npos);
  EXPECT_NE(case_hash(c, Step::kMat), case_hash(other, Step::kMat));
  EXPECT_NO_THROW(case_from_text(resolved_text(c), "case.toml"));
}

TEST(CaseRead, MatFilesThatCannotBeReadAreNamedByTheCase) {
  const auto reason = [](const std::string& text, const std::vector<std::string>& overrides = {}) {
    return message_of<InputError>([&] { make_mat(case_from_text(text, "panel.toml", overrides)); });
  };
  const auto message = reason("[mat]\nlength_mm = 9\nfile = \"/none/x.json\"");
  EXPECT_NE(message.find("panel.toml:3: mat.file = \"/none/x.json\": /none/x.json: cannot be read"), std::string::npos)
      << message;
  EXPECT_NE(message.find("No such file"), std::string::npos) << message;
  const auto backslashes = reason("[mat]\nfile = \"C:\\new\\table.json\"");  // a new line and a tab to TOML
  EXPECT_NE(backslashes.find("or single quotes: 'C:\\mats\\a.json'"), std::string::npos) << backslashes;
  EXPECT_NE(reason("", {"mat.file=/none/x.json"}).find("--set mat.file=/none/x.json: mat.file = "), std::string::npos);
}

TEST(CaseRead, BadOverridesAreAnsweredByTheirText) {
  for (const auto* text : {"press", "=3", "press.speed_m_s=", "press.compactions=[0", "press.speed_m_s=\"a", "a b=3",
                           "press.speed_m_s=1\nrun.seed=2"}) {
    const auto message = refusal("", {text});
    EXPECT_NE(message.find(std::string("--set ") + text), std::string::npos) << message;
    EXPECT_NE(message.find("key.path=value"), std::string::npos) << message;
  }
  EXPECT_NE(refusal("", {"press.speed_m_s=fast"}).find("must be a number"), std::string::npos);
}

TEST(CaseRead, FilesThatCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_NE(message_of<InputError>([&] { read_case(folder / "none.toml"); }).find("no such case file"),
            std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { read_case(folder.path()); }).find("folder"), std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { read_case(""); }).find("no case file is given"), std::string::npos);
}

}  // namespace
}  // namespace strandlab::cases
