#include "strandlab/report/plots.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

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

Plot line() {
  return {"", "", "", "", CurveStyle::kLines, 0, 1, {{"", {0, 1}, {0, 1}}}, {}};
}

std::string only_warning(const Drawn& drawn) {
  EXPECT_TRUE(drawn.pictures.empty());
  return drawn.warnings.size() == 1 ? drawn.warnings.front() : fmt::format("{} warnings", drawn.warnings.size());
}

// One gnuplot draws all; each file holds what a gnuplot of its own draws of it.
TEST(Plots, ArePngFiles) {
  const TemporaryFolder folder;
  std::vector<press::Record> records(3);
  records[1].compaction = 0.1;
  records[1].stress_MPa = 2;
  const Curve reference{"rule of mixtures", {1, 1.6}, {7000, 11200}}, one_point{"shear-lag", {1}, {7100}};
  auto panel = test::reference_panel("osb_s1");
  test::undulate(panel, 0.2, 12);
  const std::vector<Picture> pictures{{stress_plot(records), folder / "stress.png"},
                                      {compliance_plot(moduli(), "tension"), folder / "d.png"},
                                      {compaction_plot(moduli(), "tension"), folder / "c.png"},
                                      {compaction_plot(moduli(), "tension", {reference, one_point}), folder / "r.png"},
                                      {grain_angle_plot({morphology(panel, 0)}), folder / "a.png"},
                                      {thickness_strain_plot({morphology(panel, 0)}), folder / "t.png"}};
  const auto drawn = draw(pictures);
  EXPECT_TRUE(drawn.warnings.empty()) << drawn.warnings.front();
  EXPECT_EQ(drawn.pictures.size(), pictures.size());
  for (const auto& picture : pictures) {
    const auto together = test::contents(picture.file);
    EXPECT_EQ(together.substr(0, 4), kPngSignature);
    EXPECT_TRUE(draw({picture}).warnings.empty());
    EXPECT_EQ(test::contents(picture.file), together) << picture.file;
  }
  EXPECT_EQ(folder.files(), 6U);  // no scripts are left
}

// One gnuplot prints several pictures of any format, each whole and in its own file, and the same each time.
TEST(Plots, ForPaperArePdfSvgAndPng) {
  const TemporaryFolder folder;
  const auto begins = [&](PaperFormat format, const std::string& name, const std::string& first,
                          const std::string& last) {
    const Paper paper{format, 84, "sans", 8};
    const std::vector<Picture> pictures{{compaction_plot(moduli(), "tension"), folder / ("a" + name)},
                                        {compliance_plot(moduli(), "tension"), folder / ("b" + name)}};
    const auto drawn = draw(pictures, {}, paper);
    EXPECT_TRUE(drawn.warnings.empty()) << drawn.warnings.front();
    for (const auto& picture : pictures) {
      const auto text = test::contents(picture.file);
      EXPECT_EQ(text.substr(0, first.size()), first) << picture.file;
      EXPECT_NE(text.rfind(last), std::string::npos) << picture.file;
    }
  };
  begins(PaperFormat::kPdf, ".pdf", "%PDF", "%%EOF");
  begins(PaperFormat::kSvg, ".svg", "<?xml", "</svg>");
  begins(PaperFormat::kPng, ".png", kPngSignature, "IEND");
}

// The width is that of the paper: 84 mm are 238.1 points of 1/72 inch, 992 pixels of 1/300 inch, 317 of CSS.
TEST(Plots, ForPaperHaveItsWidth) {
  EXPECT_NE(gnuplot_script(line(), Paper{PaperFormat::kPdf, 84, "sans", 8}).find("size 8.4cm"), std::string::npos);
  EXPECT_NE(gnuplot_script(line(), Paper{PaperFormat::kPng, 84, "sans", 8}).find("size 992,"), std::string::npos);
  EXPECT_NE(gnuplot_script(line(), Paper{PaperFormat::kSvg, 84, "sans", 8}).find("size 317,"), std::string::npos);
}

// gnuplot goes on behind a mistake, and no picture goes into the file of another.
TEST(Plots, AMistakeCostsItsOwnPictureOnly) {
  const TemporaryFolder folder;
  const auto good = gnuplot_script(line());
  const auto drawn =
      draw_scripts({{good, folder / "a.png"}, {"plot nonsense\n", folder / "b.png"}, {good, folder / "c.png"}});
  ASSERT_EQ(drawn.warnings.size(), 1U);
  EXPECT_NE(drawn.warnings[0].find("no picture " + (folder / "b.png").string() + ": gnuplot failed: "),
            std::string::npos)
      << drawn.warnings[0];
  EXPECT_NE(drawn.warnings[0].find("nonsense"), std::string::npos) << drawn.warnings[0];
  EXPECT_EQ(drawn.pictures, (std::vector<std::filesystem::path>{folder / "a.png", folder / "c.png"}));
  EXPECT_EQ(test::contents(folder / "a.png"), test::contents(folder / "c.png"));
  EXPECT_EQ(folder.files(), 2U);
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
  const auto plot = compliance_plot({}, "tension", {{"rule of mixtures", {0, 1}, {7000, 7000}}});
  EXPECT_NE(only_warning(draw({{plot, folder / "a.png"}})).find("nothing to plot"), std::string::npos);
}

TEST(Plots, WithoutGnuplotTheRunGoesOnAndSaysSo) {
  const TemporaryFolder folder;
  const auto warning =
      only_warning(draw({{line(), folder / "a.png"}, {line(), folder / "b.png"}}, {"no_such_gnuplot"}));
  EXPECT_EQ(warning, "no picture " + (folder / "a.png").string() + ", " + (folder / "b.png").string() +
                         ": cannot start no_such_gnuplot (No such file or directory); install the package gnuplot-nox "
                         "to get plots");
  EXPECT_EQ(folder.files(), 0U);
}

TEST(Plots, FailingGnuplotIsReported) {
  const TemporaryFolder folder;
  EXPECT_NE(only_warning(draw({{line(), folder / "a.png"}}, {"false"})).find("false failed"), std::string::npos);
  EXPECT_EQ(folder.files(), 0U);
}

// A program that never ends, one that hides behind a program of its own, and one that closes its output and goes on.
TEST(Plots, AGnuplotThatHangsIsEnded) {
  const TemporaryFolder folder;
  for (const auto* what : {"exec sleep 600", "sleep 600; :", "exec >&- 2>&-; sleep 600"}) {
    const auto program = folder / "hangs";
    test::put(program, std::string("#!/bin/sh\n") + what + "\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    const auto warning = only_warning(draw({{line(), folder / "a.png"}}, {program.string(), 0.05}));
    EXPECT_NE(warning.find("was not done after 0.05 s"), std::string::npos) << what << ": " << warning;
    EXPECT_EQ(folder.files(), 1U) << what;
  }
}

// A PNG whose one chunk of data is that long (Portable Network Graphics, W3C 2003, 5.2 and 5.3), without checksums.
std::string png_of(std::size_t length) {
  const auto chunk = [](const std::string& name, std::size_t bytes) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(bytes >> static_cast<unsigned>(shift));
    return text + name + std::string(bytes, 'x') + "sums";
  };
  return "\x89PNG\r\n\x1a\n" + chunk("IDAT", length) + chunk("IEND", 0);
}

// The script reaches the program by its standard input, whole; what it prints is the picture.
TEST(Plots, TheScriptIsNoFileThatAnotherRunCouldTake) {
  const TemporaryFolder folder;
  const auto script = png_of(1 << 20);
  EXPECT_TRUE(draw_scripts({{script, folder / "a.png"}}, {"cat"}).warnings.empty());
  EXPECT_EQ(test::contents(folder / "a.png"), script);
  EXPECT_EQ(folder.files(), 1U);
}

// A gnuplot that dies while it prints: half a picture is none.
TEST(Plots, APictureThatWasBegunOnlyIsMissing) {
  const TemporaryFolder folder;
  const auto whole = png_of(1000);
  for (const std::size_t length : {0U, 4U, 12U, 500U}) {
    const auto drawn = draw_scripts({{whole.substr(0, length), folder / "a.png"}}, {"cat"});
    EXPECT_NE(only_warning(drawn).find("cat failed"), std::string::npos) << length;
  }
  EXPECT_EQ(folder.files(), 0U);
}

TEST(Plots, NothingToPlotIsSaid) {
  const TemporaryFolder folder;
  const auto plot = compliance_plot(moduli(), "bending_end_couple");
  EXPECT_NE(only_warning(draw({{plot, folder / "a.png"}})).find("nothing to plot"), std::string::npos);
}

TEST(Plots, FolderThatIsMissingIsBadInput) {
  const TemporaryFolder folder;
  EXPECT_THROW(static_cast<void>(draw({{line(), folder / "none" / "a.png"}})), InputError);
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
