// Run folders: whose results they hold, and that a refusal writes nothing.
#include "strandlab/run/folder.hpp"

#include <gtest/gtest.h>

#include "strandlab/core/error.hpp"
#include "support/temporary_folder.hpp"
#include "support/unwritable.hpp"

namespace strandlab::run {
namespace {

using test::message_of;
using test::put;
using test::TemporaryFolder;

constexpr double kSmall = 1e3;  // bytes that every test machine has free

cases::Case with(const std::string& override_text) {
  return cases::case_from_text("", "panel.toml", {override_text});
}

std::string refusal(const std::filesystem::path& folder, const cases::Case& c, double bytes = kSmall) {
  return message_of<InputError>([&] { RunFolder(folder, c, cases::Step::kMat, false, bytes); });
}

// A folder in which all steps are done.
void make_finished(const std::filesystem::path& folder, const cases::Case& c) {
  RunFolder run(folder, c, cases::Step::kMat, false, kSmall);
  std::filesystem::create_directory(run.file("panels"));
  for (const auto* name :
       {"mat.json", "press.csv", "panels/panel_0.h5", "moduli.csv", "theory.csv", "report.html", "notes.txt"})
    put(run.file(name), "x");
  for (const auto step : {cases::Step::kMat, cases::Step::kPress, cases::Step::kTest, cases::Step::kPage})
    run.set_finished(step);
}

TEST(RunFolder, KeepsResultsOfTheSameCase) {
  const TemporaryFolder folder;
  make_finished(folder / "run", cases::Case());
  cases::Case other_threads;
  other_threads.threads = 7;  // changes no result
  const RunFolder again(folder / "run", other_threads, cases::Step::kMat, false, kSmall);
  EXPECT_TRUE(again.finished(cases::Step::kTest));
  EXPECT_EQ(test::contents(again.file("moduli.csv")), "x");
}

TEST(RunFolder, HoldsTheResolvedCase) {
  const TemporaryFolder folder;
  const auto c = with("press.speed_m_s=8");
  const RunFolder run(folder / "run", c, cases::Step::kMat, false, kSmall);
  EXPECT_EQ(test::contents(run.file("case.toml")), resolved_text(c));
}

TEST(RunFolder, RefusesAnotherCaseAndSaysWhatDiffers) {
  const TemporaryFolder folder;
  make_finished(folder / "run", cases::Case());
  const auto before = test::contents(folder / "run/run.json");
  const auto message = refusal(folder / "run", with("press.speed_m_s=8"));
  EXPECT_NE(message.find("press.speed_m_s = 16 there, 8 here"), std::string::npos) << message;
  EXPECT_NE(message.find("--force"), std::string::npos) << message;
  EXPECT_EQ(test::contents(folder / "run/run.json"), before);
  EXPECT_NE(refusal(folder / "run", with("materials.m.E_L_MPa=9000")).find("materials.m.base only here"),
            std::string::npos);
}

TEST(RunFolder, ForceStartsAgainFromTheFirstStepThatDiffers) {
  const TemporaryFolder folder;
  make_finished(folder / "run", cases::Case());
  {
    const RunFolder run(folder / "run", with("glue.max_gap_mm=0.2"), cases::Step::kTest, true, kSmall);
    EXPECT_TRUE(run.finished(cases::Step::kPress));
    EXPECT_FALSE(run.finished(cases::Step::kTest));
    EXPECT_FALSE(std::filesystem::exists(run.file("moduli.csv")));
    EXPECT_FALSE(std::filesystem::exists(run.file("theory.csv")));
    EXPECT_TRUE(std::filesystem::exists(run.file("panels/panel_0.h5")));
  }
  const RunFolder run(folder / "run", with("press.speed_m_s=8"), cases::Step::kMat, true, kSmall);
  EXPECT_FALSE(run.finished(cases::Step::kTest));
  EXPECT_FALSE(run.finished(cases::Step::kPress));
  EXPECT_FALSE(std::filesystem::exists(run.file("panels")));
  EXPECT_TRUE(std::filesystem::exists(run.file("notes.txt")));  // the user's own files stay
}

// The test alone cannot press again: it refuses, and the panels stay as they are.
TEST(RunFolder, ForceOfATestNeverCostsThePanels) {
  const TemporaryFolder folder;
  make_finished(folder / "run", cases::Case());
  const auto before = test::contents(folder / "run/run.json");
  const auto message = message_of<InputError>(
      [&] { RunFolder(folder / "run", with("press.speed_m_s=8"), cases::Step::kTest, true, kSmall); });
  EXPECT_NE(message.find("press.speed_m_s = 16 there, 8 here"), std::string::npos) << message;
  EXPECT_EQ(test::contents(folder / "run/run.json"), before);
  EXPECT_EQ(test::contents(folder / "run/panels/panel_0.h5"), "x");
}

TEST(RunFolder, ATestNeedsPressedPanels) {
  const TemporaryFolder folder;
  for (const bool force : {false, true}) {
    const auto message =
        message_of<InputError>([&] { RunFolder(folder / "new", cases::Case(), cases::Step::kTest, force, kSmall); });
    EXPECT_NE(message.find("no pressed panel"), std::string::npos) << message;
    EXPECT_EQ(folder.files(), 0U);
  }
}

TEST(RunFolder, ForceOnTheSameCaseStartsAgainAtTheCommandsStep) {
  const TemporaryFolder folder;
  make_finished(folder / "run", cases::Case());
  const RunFolder run(folder / "run", cases::Case(), cases::Step::kPress, true, kSmall);
  EXPECT_TRUE(run.finished(cases::Step::kMat));
  EXPECT_FALSE(run.finished(cases::Step::kPress));
  EXPECT_FALSE(run.finished(cases::Step::kTest));
}

TEST(RunFolder, RefusesAFolderThatIsNotARun) {
  const TemporaryFolder folder;
  put(folder / "letter.txt", "dear");
  EXPECT_NE(refusal(folder.path(), cases::Case()).find("no strandlab run"), std::string::npos);
  EXPECT_EQ(folder.files(), 1U);
  put(folder / "run.json", "{\"name\": \"something else\"}");
  EXPECT_NE(refusal(folder.path(), cases::Case()).find("not the record of a strandlab run"), std::string::npos);
  put(folder / "run.json", "{\"strandlab\": ");
  EXPECT_NE(refusal(folder.path(), cases::Case()).find("run.json"), std::string::npos);
}

// Whatever stands in run.json, and however deep: at once, and in our words.
TEST(RunFolder, RefusesARecordThatIsNone) {
  const TemporaryFolder folder;
  const std::string deep(200000, '['), flat(deep.size(), ']');
  for (const auto& text : {std::string(R"({"strandlab": "1", "case": [1, 2], "steps": {}})"),
                           std::string(R"({"strandlab": "1", "case": [], "steps": {"mat": 1}})"),
                           std::string(R"({"strandlab": "1", "case": [], "steps": {"mat": {"finished": "yes"}}})"),
                           R"({"strandlab": "1", "case": [], "steps": {"mat": {"x": )" + deep + flat + "}}}"}) {
    put(folder / "run.json", text);
    EXPECT_NE(refusal(folder.path(), cases::Case()).find("the record of a strandlab run"), std::string::npos)
        << text.substr(0, 80);
  }
  std::filesystem::remove(folder / "run.json");
  std::filesystem::create_directory(folder / "run.json");
  EXPECT_NE(refusal(folder.path(), cases::Case()).find("the record of a strandlab run"), std::string::npos);
}

TEST(RunFolder, RefusesANameThatCannotBe) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink(folder / "loop", folder / "loop");
  for (const auto& name : {std::string("loop"), std::string("loop/run"), std::string(5000, 'x')})
    EXPECT_NE(refusal(folder / name, cases::Case()).find("cannot be a run folder"), std::string::npos)
        << name.substr(0, 20);
}

TEST(RunFolder, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  auto c = with("press.compactions=[0, .1]");
  c.schedule.compactions = c.states.compactions;
  make_finished(folder / "run", c);
  RunFolder run(folder / "run", c, cases::Step::kMat, false, kSmall);
  EXPECT_EQ(run.missing(cases::Step::kMat, c), std::vector<std::string>{});
  EXPECT_EQ(run.missing(cases::Step::kPress, c),
            (std::vector<std::string>{"morphology.csv", "histograms.csv", "profile.csv", "profile_summary.csv",
                                      "pictures/grain_angle_0.png", "pictures/density_0.png", "panels/panel_0.1.h5",
                                      "pictures/grain_angle_0.1.png", "pictures/density_0.1.png"}));
  run.add_plots(cases::Step::kTest, {run.file("plots") / "tension.png"});
  EXPECT_EQ(run.missing(cases::Step::kTest, c), std::vector<std::string>{"plots/tension.png"});
  std::filesystem::remove(run.file("moduli.csv"));
  EXPECT_EQ(run.missing(cases::Step::kTest, c), (std::vector<std::string>{"moduli.csv", "plots/tension.png"}));
}

TEST(RunFolder, RemovesWhatAKillLeftHalfWritten) {
  const TemporaryFolder folder;
  make_finished(folder / "run", cases::Case());
  for (const auto* name : {"run/report.html.4711-2.tmp", "run/panels/panel_0.h5.4711-1.tmp"}) put(folder / name, "x");
  const RunFolder run(folder / "run", cases::Case(), cases::Step::kMat, false, kSmall);
  EXPECT_FALSE(std::filesystem::exists(run.file("report.html.4711-2.tmp")));
  EXPECT_FALSE(std::filesystem::exists(run.file("panels/panel_0.h5.4711-1.tmp")));
  EXPECT_TRUE(std::filesystem::exists(run.file("notes.txt")));
}

// A kill between making the folder and its first file leaves at most a temporary file.
TEST(RunFolder, TakesAnEmptyFolder) {
  const TemporaryFolder folder;
  put(folder / "run.json.tmp", "{");
  EXPECT_NO_THROW(RunFolder(folder.path(), cases::Case(), cases::Step::kMat, false, kSmall));
}

TEST(RunFolder, RefusesWhatCannotBeWritten) {
  const TemporaryFolder folder;
  put(folder / "file", "");
  EXPECT_NE(refusal(folder / "file/run", cases::Case()).find("is not a folder"), std::string::npos);
  const test::ReadOnly read_only(folder.path());
  EXPECT_NE(refusal(folder / "run", cases::Case()).find("ermission denied"), std::string::npos);
}

TEST(RunFolder, RefusesADiskWithoutSpace) {
  const TemporaryFolder folder;
  const auto message = refusal(folder / "run", cases::Case(), 1e18);
  EXPECT_NE(message.find("disk space"), std::string::npos) << message;
  EXPECT_EQ(folder.files(), 0U);
}

TEST(RunFolder, RefusesAFolderInUse) {
  const TemporaryFolder folder;
  const RunFolder first(folder / "run", cases::Case(), cases::Step::kMat, false, kSmall);
  EXPECT_NE(refusal(folder / "run", cases::Case()).find("another strandlab"), std::string::npos);
}

// The page shows the results of all steps: one that is undone takes the page with it, also where it was undone in the
// folder that is open.
TEST(RunFolder, ThePageGoesWithTheResultsItShows) {
  const TemporaryFolder folder;
  for (const bool force : {false, true}) {
    make_finished(folder / "run", cases::Case());
    RunFolder run(folder / "run", cases::Case(), cases::Step::kTest, force, kSmall);
    EXPECT_EQ(std::filesystem::exists(run.file("report.html")), !force);
    run.forget(cases::Step::kPage);
    EXPECT_FALSE(run.finished(cases::Step::kPage));
    EXPECT_FALSE(std::filesystem::exists(run.file("report.html")));
    EXPECT_EQ(run.finished(cases::Step::kTest), !force);
  }
}

// A kill between the last test and the page, or a folder of a version that did not record its page.
TEST(RunFolder, APageWithoutARecordIsNoResult) {
  const TemporaryFolder folder;
  make_finished(folder / "run", cases::Case());
  auto record = nlohmann::json::parse(test::contents(folder / "run/run.json"));
  record["steps"].erase("page");
  put(folder / "run/run.json", record.dump());
  const RunFolder run(folder / "run", cases::Case(), cases::Step::kMat, false, kSmall);
  EXPECT_TRUE(run.finished(cases::Step::kTest));
  EXPECT_FALSE(run.finished(cases::Step::kPage));
  EXPECT_FALSE(std::filesystem::exists(run.file("report.html")));
}

TEST(RunFolder, RecordsAPageThatIsMadeByItself) {
  const TemporaryFolder folder;
  make_finished(folder / "run", cases::Case());
  RunFolder(folder / "run", cases::Case(), cases::Step::kMat, false, kSmall).forget(cases::Step::kPage);
  write_page(folder / "run", [&] { put(folder / "run/report.html", "page"); });
  const RunFolder run(folder / "run", cases::Case(), cases::Step::kMat, false, kSmall);
  EXPECT_TRUE(run.finished(cases::Step::kPage));
  EXPECT_EQ(test::contents(run.file("report.html")), "page");
  const auto never = [] { FAIL() << "wrote a page"; };
  EXPECT_NE(message_of<InputError>([&] { write_page(folder / "run", never); }).find("another strandlab"),
            std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { write_page(folder / "none", never); }).find("no run.json"), std::string::npos);
}

// Several pages may be made at once: none shuts out another.
TEST(RunFolder, PagesAreMadeAtTheSameTime) {
  const TemporaryFolder folder;
  make_finished(folder / "run", cases::Case());
  bool inner = false;
  write_page(folder / "run", [&] { write_page(folder / "run", [&] { inner = true; }); });
  EXPECT_TRUE(inner);
}

// Files of a pressing that was forgotten by --force just before a kill must not be taken for results.
TEST(RunFolder, RemovesFilesOfStepsItDoesNotKnow) {
  const TemporaryFolder folder;
  { const RunFolder run(folder / "run", cases::Case(), cases::Step::kMat, false, kSmall); }
  put(folder / "run/checkpoint.h5", "old");
  const RunFolder run(folder / "run", cases::Case(), cases::Step::kMat, false, kSmall);
  EXPECT_FALSE(std::filesystem::exists(run.file("checkpoint.h5")));
}

}  // namespace
}  // namespace strandlab::run
