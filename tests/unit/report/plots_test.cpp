#include "strandlab/report/plots.hpp"

#include <gtest/gtest.h>

#include <string>

#include "strandlab/core/error.hpp"
#include "strandlab/report/gnuplot.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_panel.hpp"

namespace strandlab::report {
namespace {

using test::TemporaryFolder;

constexpr const char* kPngSignature = "\x89PNG";

std::vector<PanelModulus> moduli() {
  std::vector<PanelModulus> all;
  for (const char* test : {"tension", "bending_end_rotation"}) {
    for (const double compaction : {0.0, 0.2, 0.4}) {
      for (const double compliance : {0.0, 0.0105, 0.05}) {
        all.push_back({compaction, test, compliance, 7000 / (1 - compaction) - 1e4 * compliance, 0});
      }
    }
  }
  return all;
}

void expect_picture(const Warning& warning, const std::filesystem::path& png) {
  EXPECT_EQ(warning, std::nullopt) << *warning;
  EXPECT_EQ(test::contents(png).substr(0, 4), kPngSignature);
}

TEST(Plots, ArePngFiles) {
  const TemporaryFolder folder;
  std::vector<press::Record> records(3);
  records[1].compaction = 0.1;
  records[1].stress_MPa = 2;
  expect_picture(plot_stress(records, folder / "stress.png"), folder / "stress.png");
  expect_picture(plot_modulus_against_compliance(moduli(), "tension", folder / "d.png"), folder / "d.png");
  expect_picture(plot_modulus_against_compaction(moduli(), "tension", folder / "c.png"), folder / "c.png");
  const Curve reference{"rule of mixtures", {1, 1.6}, {7000, 11200}}, one_point{"shear-lag", {1}, {7100}};
  expect_picture(plot_modulus_against_compaction(moduli(), "tension", folder / "r.png", {reference, one_point}),
                 folder / "r.png");
  auto panel = test::reference_panel("osb_s1");
  test::undulate(panel, 0.2, 12);
  expect_picture(plot_grain_angles({morphology(panel, 0)}, folder / "a.png"), folder / "a.png");
  expect_picture(plot_thickness_strains({morphology(panel, 0)}, folder / "t.png"), folder / "t.png");
  EXPECT_EQ(folder.files(), 6U);  // no scripts are left
}

TEST(Plots, ScriptHoldsTheNumbersAndTheNames) {
  Plot plot{"A \"title\"", "x, mm", "y, MPa", "compaction", CurveStyle::kLinesAndPoints, 0, 2, {}, {}};
  plot.curves = {{"0 %", {0, 1.5}, {3, 4.25}}, {"10 %", {0, 1.5}, {5, 6}}};
  const std::string script = gnuplot_script(plot);
  for (const char* part : {"set title \"A \\\"title\\\"\"", "set xlabel \"x, mm\"", "set xrange [0:2]", "1.5 4.25\n",
                           "title \"0 %\"", "title \"10 %\"", "title \"compaction\""}) {
    EXPECT_NE(script.find(part), std::string::npos) << part << "\n" << script;
  }
}

TEST(Plots, ReferencesAreDashedLinesOverTheCurvesWithOneKeyEntryPerName) {
  Plot plot{"", "x", "y", "compaction", CurveStyle::kLinesAndPoints, 0, 2, {{"0 %", {0, 1.5}, {3, 4.25}}}, {}};
  EXPECT_NE(gnuplot_script(plot).find("unset key"), std::string::npos);
  plot.references = {{"rule of mixtures", {0, 1.5}, {7, 7.5}}, {"", {0, 1.5}, {8, 8.5}}, {"shear-lag", {0.5}, {6.25}}};
  const std::string script = gnuplot_script(plot);
  EXPECT_EQ(script.find("unset key"), std::string::npos);
  for (const char* part : {"$reference0 << END\n0 7\n1.5 7.5\nEND\n", "$reference1 << END\n0 8\n1.5 8.5\nEND\n",
                           "$reference2 << END\n0.5 6.25\nEND\n",
                           "$reference0 using 1:2 with lines dt 2 lw 2 lc rgb \"#303030\" title \"rule of mixtures\"",
                           "$reference1 using 1:2 with lines dt 2 lw 2 lc rgb \"#303030\" title \"\"",
                           // A line of one point would not be seen.
                           "$reference2 using 1:2 with points pt 2 ps 2 lw 2 lc rgb \"#303030\" title \"shear-lag\""}) {
    EXPECT_NE(script.find(part), std::string::npos) << part << "\n" << script;
  }
  EXPECT_LT(script.find("$curve0 using"), script.find("$reference0 using"));  // later is drawn over
}

TEST(Plots, ReferencesAloneAreNoResult) {
  const TemporaryFolder folder;
  const auto warning =
      plot_modulus_against_compliance({}, "tension", folder / "a.png", {{"rule of mixtures", {0, 1}, {7000, 7000}}});
  ASSERT_TRUE(warning.has_value());
  EXPECT_NE(warning->find("nothing to plot"), std::string::npos);
}

TEST(Plots, WithoutGnuplotTheRunGoesOnAndSaysSo) {
  const TemporaryFolder folder;
  const Plot plot{"", "", "", "", CurveStyle::kLines, 0, 1, {{"", {0, 1}, {0, 1}}}, {}};
  const auto warning = draw(plot, folder / "a.png", {"no_such_gnuplot"});
  ASSERT_TRUE(warning.has_value());
  EXPECT_EQ(*warning,
            "no picture " + (folder / "a.png").string() +
                ": cannot start no_such_gnuplot (No such file or directory); install the package gnuplot-nox to "
                "get plots");
  EXPECT_EQ(folder.files(), 0U);
}

TEST(Plots, FailingGnuplotIsReported) {
  const TemporaryFolder folder;
  const Plot plot{"", "", "", "", CurveStyle::kLines, 0, 1, {{"", {0, 1}, {0, 1}}}, {}};
  const auto warning = draw(plot, folder / "a.png", {"false"});
  ASSERT_TRUE(warning.has_value());
  EXPECT_NE(warning->find("false failed"), std::string::npos);
  EXPECT_EQ(folder.files(), 0U);
}

// A program that never ends, one that hides behind a program of its own, and one that closes its output and goes on.
TEST(Plots, AGnuplotThatHangsIsEnded) {
  const TemporaryFolder folder;
  const Plot plot{"", "", "", "", CurveStyle::kLines, 0, 1, {{"", {0, 1}, {0, 1}}}, {}};
  for (const auto* what : {"exec sleep 600", "sleep 600; :", "exec >&- 2>&-; sleep 600"}) {
    const auto program = folder / "hangs";
    test::put(program, std::string("#!/bin/sh\n") + what + "\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    const auto warning = draw(plot, folder / "a.png", {program.string(), 0.05});
    ASSERT_TRUE(warning.has_value()) << what;
    EXPECT_NE(warning->find("was not done after 0.05 s"), std::string::npos) << *warning;
    EXPECT_EQ(folder.files(), 1U) << what;
  }
}

// The script reaches the program by its standard input, whole; what it prints is the picture.
TEST(Plots, TheScriptIsNoFileThatAnotherRunCouldTake) {
  const TemporaryFolder folder;
  std::string script = "plot";
  script.append(1 << 20, 'x');
  EXPECT_FALSE(draw_script(script, folder / "a.png", {"cat"}).has_value());
  EXPECT_EQ(test::contents(folder / "a.png"), script);
  EXPECT_EQ(folder.files(), 1U);
}

TEST(Plots, NothingToPlotIsSaid) {
  const TemporaryFolder folder;
  const auto warning = plot_modulus_against_compliance(moduli(), "bending_end_couple", folder / "a.png");
  ASSERT_TRUE(warning.has_value());
  EXPECT_NE(warning->find("nothing to plot"), std::string::npos);
}

TEST(Plots, FolderThatIsMissingIsBadInput) {
  const TemporaryFolder folder;
  EXPECT_THROW(static_cast<void>(plot_modulus_against_compliance(moduli(), "tension", folder / "none" / "a.png")),
               InputError);
}

TEST(ResultTables, HaveTheColumnsScriptsRelyOn) {
  press::Record record;
  record.compaction = 0.1;
  record.time_ms = 0.25;
  record.stress_MPa = 3;
  record.force_top_N = 301;
  record.force_bottom_N = 299;
  record.kinetic_mJ = 1;
  record.elastic_mJ = 5;
  record.plastic_mJ = 7;
  const std::string press = press_table({record}).text();
  EXPECT_EQ(press.substr(0, press.find(",elastic")),
            "compaction,time_ms,stress_MPa,force_top_N,force_bottom_N,kinetic_mJ,internal_mJ,plastic_mJ");
  EXPECT_NE(press.find("\n0.1,0.25,3,301,299,1,12,7,"), std::string::npos) << press;
  EXPECT_EQ(
      moduli_table({{0.2, "tension", 0.0105, 5432.1, 5432.2, {}, 437.5},
                    {0.2, "bending_3_point", 0, 4800.5, 4800.5, 5000.25, 437.5}})
          .text(),
      "compaction,test,compliance_t_mm_per_MPa,modulus_MPa,reaction_modulus_MPa,shear_free_modulus_MPa,density_kg_m3\n"
      "0.2,tension,0.0105,5432.1,5432.2,nan,437.5\n0.2,bending_3_point,0,4800.5,4800.5,5000.25,437.5\n");
}

}  // namespace
}  // namespace strandlab::report
