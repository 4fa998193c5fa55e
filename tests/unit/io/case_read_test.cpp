// Case files: what is read, and the one message that answers each kind of bad input.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "case_samples.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/io/case_estimate.hpp"
#include "strandlab/io/case_keys.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::io {
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
  EXPECT_EQ(c.schedule.compactions, (std::vector<double>{0, 0.2, 0.35}));
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
  EXPECT_EQ(c.schedule.compactions, (std::vector<double>{0, 0.1, 0.2, 0.3, 0.4}));
  EXPECT_EQ(c.test.compliance_t_mm_per_MPa, (std::vector<double>{0, 0.0021, 0.0105, 0.0163, 0.05}));
  EXPECT_EQ(strand_kinds(c)[1].angle_deg, 90);
}

// Every key can be set in a file and reads back, so no key of the table is dead or bound to another's member.
TEST(CaseRead, EveryKeyIsStored) {
  for (const auto& sample : samples()) {
    const Case c = case_from_text(sample.section + "\n" + sample.key + " = " + sample.value, "panel.toml");
    EXPECT_EQ(to_toml(sample.entry->get(c, sample.name)), sample.value) << sample.entry->path;
    const Case overridden = case_from_text("", "panel.toml", {sample.dotted + "=" + sample.value});
    EXPECT_EQ(to_toml(sample.entry->get(overridden, sample.name)), sample.value) << sample.entry->path;
    const auto own_name = name_of(*sample.entry);
    if (own_name == "base" || own_name == "species") continue;  // they set the constants
    for (const auto& other : keys()) {                          // and nothing else has changed
      if (&other == sample.entry || section_of(other) != section_of(*sample.entry)) continue;
      EXPECT_EQ(to_toml(other.get(c, sample.name)), to_toml(other.get(plain_case(sample), sample.name)))
          << sample.entry->path << " changes " << other.path;
    }
  }
}

TEST(CaseRead, LaterOverridesWin) {
  const Case c = case_from_text("[press]\nspeed_m_s = 4", "panel.toml", {"press.speed_m_s=8", "press.speed_m_s=2"});
  EXPECT_EQ(c.schedule.speed_m_s, 2);
}

TEST(CaseRead, BareWordsAreTexts) {
  const Case c = case_from_text(
      "", "panel.toml", {"press.sides=free", "test.kinds=[tension, bending_end_couple]", "mat.file=/data/a.json"});
  EXPECT_EQ(c.sides, mpm::Side::kFree);
  EXPECT_EQ(c.test.kinds, (std::vector{vtest::Kind::kTension, vtest::Kind::kBendingEndCouple}));
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
  EXPECT_EQ(m.Y_R, 5);           // of poplar, the base
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
  const Case c = case_from_text(
      "[mat]\nlength_mm = 40\nrows = [\"surface\", \"core\"]\nlayer_thickness_mm = 0.7\n"
      "[kinds.surface]\nthickness_mm = 1.4\n[kinds.core]\nangle_deg = 10\nangle_spread_deg = 5\n",
      "panel.toml");
  const auto mat = make_mat(c);
  EXPECT_EQ(mat.thickness_of(0), 1.4);
  EXPECT_EQ(mat.thickness_of(1), .7);
  EXPECT_FALSE(mat.layers[0].strands[0].angle_deg);
  for (const auto& strand : mat.layers[1].strands) EXPECT_NEAR(strand.angle_deg.value(), 10, 5);
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
      {"[mat]\nlength_mm = -100", {"panel.toml:2", "mat.length_mm = -100 mm", "greater than 0"}},
      {"[mat]\nlayer_thickness_mm = 0", {"panel.toml:2", "mat.layer_thickness_mm = 0 mm", "greater than 0"}},
      {"[materials.m]\ndensity_kg_m3 = 0", {"panel.toml:2", "materials.m.density_kg_m3 = 0 kg/m3", "greater than 0"}},
      {"[materials.m]\nE_R_MPa = -914", {"panel.toml:2", "materials.m.E_R_MPa = -914 MPa", "greater than 0"}},
      {"[materials.m]\nG_RT_MPa = 0", {"panel.toml:2", "materials.m.G_RT_MPa = 0 MPa"}},
      {"[kinds.surface]\nlength_sd_mm = 151", {"panel.toml:2", "kinds.surface.length_sd_mm = 151", "length_mm = 150"}},
      {"[kinds.core]\ngap_mm = 0.5", {"panel.toml:2", "kinds.core.gap_sd_mm = 1", "gap_mm = 0.5"}},
      {"[kinds.core]\nlength_mm = 0\nlength_sd_mm = 0", {"kinds.core.length_mm", "gap_mm must be 0 too"}},
      {"[press]\ncompactions = [0, 1]", {"panel.toml:2", "press.compactions = [0, 1]", "less than 1"}},
      {"[press]\ncompactions = [0.2, 0.1]", {"press.compactions = [0.2, 0.1]", "increasing"}},
      {"[press]\ncompactions = [0.2, 0.2]", {"increasing"}},
      {"[press]\ncompactions = [-0.1, 0.2]", {"from 0"}},
      {"[press]\ncompactions = []", {"must not be empty"}},
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
      {"[kinds.core]\nthickness_mm = -1", {"panel.toml:2", "kinds.core.thickness_mm = -1 mm", "0 or more"}},
      {"[kinds.core]\nangle_spread_deg = 100", {"kinds.core.angle_spread_deg = 100 degrees", "from 0 to 90"}},
      {"[kinds.core]\nyield_factor = 0", {"kinds.core.yield_factor = 0", "greater than 0 and at most 1"}},
      {"[kinds.core]\nstiffness_factor = 2", {"kinds.core.stiffness_factor = 2", "greater than 0 and at most 1"}},
      {"[materials.m]\nspecies = \"douglas fir\"",
       {"panel.toml:2", "materials.m.species", "yellow-poplar", "did you mean douglas-fir?"}},
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
}

}  // namespace
}  // namespace strandlab::io
