// Studies of a small case: their items, what they share, that they are done once, and what becomes of failures.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <future>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "child.hpp"
#include "samples.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/run/journey.hpp"
#include "strandlab/run/press.hpp"
#include "strandlab/study/claim.hpp"
#include "strandlab/study/collect.hpp"
#include "strandlab/study/item.hpp"
#include "strandlab/study/runner.hpp"
#include "support/unwritable.hpp"

namespace strandlab::study {
namespace {

namespace fs = std::filesystem;
using test::contents;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kTwoSpeeds = "replicates = 2\n[axes]\n'press.speed_m_s' = [16, 32]\n";
constexpr const char* kTables[] = {"results.csv", "summary.csv", "effects.csv", "profiles.csv", "press.csv"};

std::string refusal_of(const std::string& text) {
  const TemporaryFolder folder;
  return test::message_of<InputError>([&] { small_items(plan_of("base = 'small.toml'\n" + text, folder.path())); });
}

std::vector<Failure> run_all(const Study& study, Keep keep = Keep::kPanels) {
  run::Observer nobody;
  RunnerOptions options;
  options.workers = 2;
  options.keep = keep;
  return run_items(study, options, nobody);
}

std::vector<std::string> tables_of(const Study& study) {
  collect(study);
  std::vector<std::string> texts;
  for (const auto* name : kTables) texts.push_back(contents(study.file(name)));
  return texts;
}

// Every modulus with all its digits.
std::string moduli_of(const run::Tested& tested) {
  std::string text;
  for (const auto& state : tested)
    for (const auto& m : state.result.moduli) text += fmt::format("{}\n", m.modulus_MPa);
  return text;
}

TEST(StudyItems, ReplicatesShareTheirMatsAcrossAnAxisThatLeavesThemAlone) {
  const TemporaryFolder folder;
  const auto items =
      small_items(plan_of(std::string("base = 'small.toml'\nbase_seed = 7\n") + kTwoSpeeds, folder.path()));
  ASSERT_EQ(items.size(), 4U);
  EXPECT_EQ(items[0].item.seed, 7U);
  EXPECT_EQ(items[1].item.seed, 7U);
  EXPECT_EQ(items[2].item.seed, 8U);
  EXPECT_EQ(items[0].mat, items[1].mat);
  EXPECT_NE(items[0].mat, items[2].mat);
  EXPECT_NE(items[0].item.pressing, items[1].item.pressing);
}

// What the pressing does not depend on: glue, tests.
TEST(StudyItems, OnePressingServesAllGluesAndTests) {
  const TemporaryFolder folder;
  const auto items =
      small_items(plan_of("base = 'small.toml'\n[axes]\n'glue.max_gap_mm' = [0.1, 0.2]\n"
                          "'test.kinds' = [['tension'], ['tension', 'bending_end_couple']]\n",
                          folder.path()));
  std::set<std::string> hashes, pressings;
  for (const auto& planned : items) {
    hashes.insert(planned.item.hash);
    pressings.insert(planned.item.pressing);
  }
  EXPECT_EQ(hashes.size(), 4U);
  EXPECT_EQ(pressings.size(), 1U);
}

TEST(StudyItems, RefusesWhatNoCaseTakes) {
  EXPECT_THAT(refusal_of("[axes]\n'press.sped_m_s' = [4]"),
              HasSubstr("plan.toml:3: unknown key press.sped_m_s; did you mean speed_m_s?"));
  EXPECT_THAT(refusal_of("[axes]\n'press.speed_m_s' = ['fast']"),
              HasSubstr("plan.toml:3: press.speed_m_s = \"fast\" m/s: must be a number"));
  EXPECT_THAT(refusal_of("[set]\n'press.speed_m_s' = -1"), HasSubstr("plan.toml:3: press.speed_m_s = -1 m/s"));
  EXPECT_THAT(refusal_of("[axes]\n'press.densities_kg_m3' = [[100, 640]]"),
              HasSubstr("plan.toml:3: press.densities_kg_m3 = [100, 640] kg/m3: entry 1"));
  EXPECT_THAT(refusal_of("[axes]\n'run.threads' = [1, 2]"),
              HasSubstr("plan.toml: two items are the same case: item of replicate 1, run.threads = 1; and item of "
                        "replicate 1, run.threads = 2"));
  EXPECT_THAT(refusal_of("[one_at_a_time]\n'press.speed_m_s' = [16]"), HasSubstr("two items are the same case"));
  run::Observer nobody;
  EXPECT_THAT(test::message_of<InputError>([&] { items_of(plan_of("base = 'osbb'"), nobody); }),
              HasSubstr("plan.toml: base = \"osbb\": neither a file in . nor a ready case; did you mean \"osb\"?"));
}

// The same panel several times would narrow the interval without any reason.
TEST(StudyItems, RefusesReplicatesOfAMatFromAFile) {
  const TemporaryFolder folder;
  test::put(folder / "small.toml", kSmallCase);
  run::Observer nobody;
  run::form(cases::read_case(folder / "small.toml"), {folder / "run"}, nobody);
  EXPECT_THAT(test::message_of<InputError>([&] {
                small_items(plan_of("base = 'small.toml'\nreplicates = 2\n[set]\n'mat.file' = '" +
                                        (folder / "run/mat.json").string() + "'\n",
                                    folder.path()));
              }),
              HasSubstr("replicates = 2, but the mat is read from mat.file"));
}

TEST(StudyFolder, IsTheStudyThatWasWritten) {
  const TemporaryFolder folder;
  const auto written = small_study(kTwoSpeeds, folder.path());
  const auto read = open_study(folder / "study");
  ASSERT_EQ(read.items.size(), written.items.size());
  for (std::size_t i = 0; i < read.items.size(); ++i) {
    EXPECT_EQ(read.items[i].hash, written.items[i].hash);
    EXPECT_EQ(read.items[i].pressing, written.items[i].pressing);
    EXPECT_EQ(read.items[i].seed, written.items[i].seed);
    EXPECT_EQ(read.items[i].values, written.items[i].values);
  }
  EXPECT_EQ(find_item(read, "3").hash, read.items[2].hash);
  EXPECT_EQ(find_item(read, read.items[3].hash).number, 4);
  for (const auto* name : {"0", "5", "x", "3.0"})
    EXPECT_THAT(test::message_of<InputError>([&] { find_item(read, name); }), HasSubstr("items are 1 to 4"));
}

TEST(StudyFolder, RefusesWhatIsNoStudyAndWritesNothing) {
  const TemporaryFolder folder;
  test::put(folder / "study", "");
  EXPECT_THAT(test::message_of<InputError>([&] { small_study("", folder.path()); }), HasSubstr("this is not a folder"));
  fs::remove(folder / "study");
  fs::create_directory(folder / "study");
  test::put(folder / "study/letter.txt", "dear");
  EXPECT_THAT(test::message_of<InputError>([&] { small_study("", folder.path()); }),
              HasSubstr("no study (no plan.csv)"));
  EXPECT_FALSE(fs::exists(folder / "study/plan.toml"));
  fs::rename(folder / "study/letter.txt", folder / "study/plan.toml");  // somebody's own plan
  EXPECT_THAT(test::message_of<InputError>([&] { small_study("", folder.path()); }), HasSubstr("no study"));
  EXPECT_EQ(contents(folder / "study/plan.toml"), "dear");
  fs::remove(folder / "study/plan.toml");
  EXPECT_THAT(test::message_of<InputError>([&] { open_study(folder / "study"); }), HasSubstr("holds no study"));
}

TEST(StudyFolder, RefusesAnotherPlanButTakesMore) {
  const TemporaryFolder folder;
  small_study(kTwoSpeeds, folder.path());
  const auto before = contents(folder / "study/plan.csv");
  EXPECT_THAT(test::message_of<InputError>(
                  [&] { small_study("replicates = 2\n[axes]\n'press.speed_m_s' = [16, 24]\n", folder.path()); }),
              HasSubstr("holds the study of another plan: 2 of its pressings are not in this one, the first in the "
                        "line \"2,"));
  EXPECT_EQ(contents(folder / "study/plan.csv"), before);
  EXPECT_EQ(small_study("replicates = 3\n[axes]\n'press.speed_m_s' = [16, 32, 24]\n", folder.path()).items.size(), 9U);
}

TEST(StudyFolder, RefusesAPlanTableThatIsNotOfItsPlan) {
  const TemporaryFolder folder;
  const auto study = small_study(kTwoSpeeds, folder.path());
  const auto table = contents(study.file("plan.csv"));
  for (const auto& bad : {table.substr(0, table.size() / 2), table + "5" + table.substr(table.rfind("\n4,") + 2),
                          std::string("item\n1,2,3\n"), std::string()}) {
    test::put(study.file("plan.csv"), bad);
    EXPECT_THAT(test::message_of<InputError>([&] { open_study(study.folder); }),
                HasSubstr("strandlab study plan writes this file again"))
        << bad;
  }
}

TEST(StudyItem, CaseChangedByHandIsRefused) {
  const TemporaryFolder folder;
  const auto study = small_study("", folder.path());
  const auto file = study.item_folder(study.items[0]) / "case.toml";
  test::put(file, contents(file) + "\n");
  EXPECT_EQ(read_item_case(study, study.items[0]).schedule.speed_m_s, 16);
  test::put(file, "[press]\nspeed_m_s = 4\n");
  EXPECT_THAT(test::message_of<InputError>([&] { read_item_case(study, study.items[0]); }),
              HasSubstr("not the case of item 1 any more"));
}

TEST(StudyClaim, OneHolderAtATime) {
  const TemporaryFolder folder;
  {
    auto claim = Claim::attempt(folder / "item");
    ASSERT_TRUE(claim);
    EXPECT_FALSE(Claim::attempt(folder / "item"));
    const Claim moved = std::move(*claim);
    EXPECT_FALSE(Claim::attempt(folder / "item"));
  }
  EXPECT_TRUE(Claim::attempt(folder / "item"));
}

// The moduli of an item are those of a run of the same case, bit for bit.
TEST(StudyRun, ItemsHaveTheModuliOfRuns) {
  const TemporaryFolder folder;
  const auto study = small_study("", folder.path());
  EXPECT_THAT(run_all(study), IsEmpty());
  in_another_process([&] {  // the tests start threads of their libraries, and a study forks
    const auto formed = run::form(cases::read_case(folder / "small.toml"));
    run::Observer nobody;
    auto tested = run::test(formed, run::press(formed, nobody).panels, nobody);
    test::put(folder / "moduli", moduli_of(tested));
  });
  const auto record = read_record(study, study.items[0]);
  ASSERT_TRUE(record.whole);
  EXPECT_EQ(moduli_of(record.tested), contents(folder / "moduli"));
  EXPECT_FALSE(moduli_of(record.tested).empty());
}

TEST(StudyRun, ExtensionRunsOnlyWhatIsNew) {
  const TemporaryFolder folder;
  run_all(small_study("[set]\n'glue.max_gap_mm' = 0.1\n", folder.path()));
  const auto study = small_study("replicates = 2\n[axes]\n'glue.max_gap_mm' = [0.1, 0.2]\n", folder.path());
  const auto written = [&](const fs::path& file) { return fs::last_write_time(file); };
  const auto item = study.item_folder(study.items[0]) / "item.json",
             pressing = study.pressing_folder(study.items[0]) / "pressing.json";
  const auto item_time = written(item), pressing_time = written(pressing);
  EXPECT_THAT(run_all(study), IsEmpty());
  EXPECT_EQ(written(item), item_time);
  EXPECT_EQ(written(pressing), pressing_time);  // for the other gap too
  EXPECT_EQ(collect(study).whole, 4U);
}

// Panels and checkpoints that are damaged are made again, to the same bytes.
TEST(StudyRun, DamagedStatesCostNoResult) {
  const TemporaryFolder folder, other;
  const auto study = small_study("", folder.path());
  EXPECT_THAT(run_all(study), IsEmpty());
  const auto expected = tables_of(study);
  const auto item = study.item_folder(study.items[0]), pressing = study.pressing_folder(study.items[0]);
  fs::remove(item / "item.json");
  test::put(pressing / "panels/panel_0.02.h5", "damaged");
  EXPECT_THAT(run_all(study), IsEmpty());
  EXPECT_EQ(tables_of(study), expected);
  EXPECT_THAT(contents(item / "log.txt"), HasSubstr("the item is pressed again"));
  const auto again = small_study("", other.path());
  const auto place = again.pressing_folder(again.items[0]);
  fs::create_directories(place);
  for (const auto* name : {"checkpoint.h5", "checkpoint.previous.h5"}) test::put(place / name, "damaged");
  EXPECT_THAT(run_all(again), IsEmpty());
  EXPECT_EQ(tables_of(again), expected);
  EXPECT_THAT(contents(again.item_folder(again.items[0]) / "log.txt"), HasSubstr("the pressing begins again"));
}

TEST(StudyRun, KeepingModuliLeavesTablesOnly) {
  const TemporaryFolder folder, other;
  const auto study = small_study("[axes]\n'glue.max_gap_mm' = [0.1, 0.2]\n", folder.path());
  EXPECT_THAT(run_all(study, Keep::kModuli), IsEmpty());
  EXPECT_FALSE(fs::exists(study.pressing_folder(study.items[0]) / "panels"));
  const auto kept = small_study("[axes]\n'glue.max_gap_mm' = [0.1, 0.2]\n", other.path());
  run_all(kept);
  EXPECT_EQ(tables_of(study), tables_of(kept));
}

// An item whose panels cannot be written is recorded, the other is run; the next call tries again.
TEST(StudyRun, AFailedItemDoesNotStopTheOthers) {
  const TemporaryFolder folder;
  const auto study = small_study("[axes]\n'press.speed_m_s' = [16, 32]\n", folder.path());
  const auto place = study.pressing_folder(study.items[0]);
  fs::create_directories(place);
  test::put(place / "panels", "a file where a folder should be");
  const auto failures = run_all(study);
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_EQ(failures[0].item, 1);
  EXPECT_THAT(failures[0].error, HasSubstr("cannot make the folder"));
  EXPECT_EQ(collect(study).whole, 1U);
  EXPECT_EQ(collect(study).failures.at(0).error, failures[0].error);
  fs::remove(place / "panels");
  EXPECT_THAT(run_all(study), IsEmpty());
  EXPECT_EQ(collect(study).whole, 2U);
  EXPECT_THAT(collect(study).failures, IsEmpty());
}

// 20 kB: room for records, none for panels. 100 bytes: not even the error can be recorded.
TEST(StudyRun, AFullDiskCostsNoResultOnceThereIsSpace) {
  for (const auto& [bytes, said] : {std::pair{20000, "File too large"}, {100, "is the disk full?"}}) {
    const TemporaryFolder folder;
    const auto study = small_study("", folder.path());
    std::vector<Failure> failures;
    {
      const test::FullDisk full(static_cast<rlim_t>(bytes));
      failures = run_all(study);
    }
    ASSERT_EQ(failures.size(), 1U);
    EXPECT_THAT(failures[0].error, HasSubstr(said));
    EXPECT_THAT(run_all(study), IsEmpty());
    EXPECT_EQ(collect(study).whole, 1U);
  }
}

TEST(StudyRun, RefusesItemsBeyondItsMemory) {
  const TemporaryFolder folder;
  const auto study = small_study("", folder.path());
  run::Observer nobody;
  const auto failures = run_items(study, {1, 1e6, Keep::kPanels}, nobody);
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_THAT(failures[0].error, HasSubstr("the study may take 1 MB"));
}

TEST(StudyRun, RefusesToForkAProcessOfSeveralThreads) {
  const TemporaryFolder folder;
  const auto study = small_study("", folder.path());
  std::promise<void> end;
  std::thread other([&] { end.get_future().wait(); });
  EXPECT_THAT(test::message_of<RunError>([&] { run_all(study); }), HasSubstr("this one has 2 threads"));
  end.set_value();
  other.join();
}

TEST(StudyRun, EndsItsWorkersWhenItIsCancelled) {
  const TemporaryFolder folder;
  const auto study = small_study(kTwoSpeeds, folder.path());
  struct Impatient final : run::Observer {
    bool cancelled() override { return true; }
  } impatient;
  EXPECT_THROW(run_items(study, {2, 0, Keep::kPanels}, impatient), Cancelled);
  for (const auto& item : study.items) EXPECT_TRUE(Claim::attempt(study.item_folder(item)));
  EXPECT_THAT(run_all(study), IsEmpty());
}

TEST(StudyRun, AnItemWhoseRecordIsDamagedIsRunAgain) {
  const TemporaryFolder folder;
  const auto study = small_study("", folder.path());
  run_all(study);
  const auto expected = tables_of(study);
  const auto file = study.item_folder(study.items[0]) / "item.json";
  for (const auto& bad : {std::string("{"), std::string("[]"),
                          std::string("{\"tested\": [], \"states\": [], \"whole\": true, \"hash\": \"\"}")}) {
    test::put(file, bad);
    EXPECT_FALSE(read_record(study, study.items[0]).error.empty());
    EXPECT_THAT(run_all(study), IsEmpty());
    EXPECT_EQ(tables_of(study), expected);
  }
}

}  // namespace
}  // namespace strandlab::study
