// The journey through a run folder when its observer stops it, and the same steps without a folder.
#include "strandlab/run/journey.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "strandlab/run/press.hpp"
#include "strandlab/run/record.hpp"
#include "support/fontconfig_leaks.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::run {
namespace {

namespace fs = std::filesystem;
using test::contents;
using test::TemporaryFolder;

// Two rows of 5 mm pressed to 2 %.
cases::Case small_case() {
  return cases::case_from_text(
      "[mat]\nlength_mm = 5\nrows = ['surface', 'core']\n"
      "[kinds.core]\nlength_mm = 2\nlength_sd_mm = 0.2\ngap_mm = 1\ngap_sd_mm = 0.2\n"
      "[press]\nspeed_m_s = 8\ncompactions = [0, 0.02]\n"
      "[glue]\ncompliance_t_mm_per_MPa = [0, 0.0105]\n",
      "small.toml");
}

// Counts how often it is asked, and stops the run at one of these times; `from_step` is what has to be told first.
class Stopper final : public Observer {
 public:
  explicit Stopper(long stop_at = -1, std::string from_step = "")
      : stop_at_(stop_at), from_step_(std::move(from_step)) {}
  void progress(const Progress& progress) override {
    if (progress.step == from_step_) from_step_.clear();
    if (progress.step == "test") tests_.push_back(progress.detail);
  }
  bool cancelled() override { return from_step_.empty() && ++asked_ == stop_at_; }
  long asked() const { return asked_; }
  const std::vector<std::string>& tests() const { return tests_; }

 private:
  long stop_at_, asked_ = 0;
  std::string from_step_;
  std::vector<std::string> tests_;
};

// Every file by name, but those of the moment (log, times in run.json and the page, when checkpoints were written).
std::map<std::string, std::string> results(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto name = entry.path().lexically_relative(folder).string();
    if (entry.is_directory() || name == "log.txt" || name == "run.json" || name == "report.html" ||
        name == "checkpoint.previous.h5")
      continue;
    files[name] = contents(entry.path());
  }
  return files;
}

std::vector<double> moduli(const Tested& tested) {
  std::vector<double> values;
  for (const auto& state : tested)
    for (const auto& m : state.result.moduli) values.push_back(m.modulus_MPa);
  return values;
}

static_assert(!std::is_base_of_v<std::runtime_error, Cancelled>);  // no handler of failures takes it for one

// Stopped twice while it presses and twice between solutions of the tests, a run goes on to the bytes of one that was
// left alone.
TEST(CancelledRun, GoesOnToTheSameBytes) {
  const auto c = small_case();
  const TemporaryFolder folder;
  Stopper undisturbed;
  const auto expected = all(c, {folder / "undisturbed"}, undisturbed);
  ASSERT_GT(undisturbed.asked(), 150);

  const Place place{folder / "stopped"};
  for (const long stop_at : {40L, 30L}) {
    Stopper in_press(stop_at);
    EXPECT_THROW(all(c, place, in_press), Cancelled);
    EXPECT_TRUE(fs::exists(place.folder / "checkpoint.h5"));
    EXPECT_FALSE(fs::exists(place.folder / "panels/panel_0.02.h5"));
  }
  for (const long stop_at : {5L, 15L}) {  // in the tests of the first panel, of the second
    Stopper in_test(stop_at, "test");
    EXPECT_THROW(all(c, place, in_test), Cancelled);
    EXPECT_EQ(fs::exists(place.folder / "moduli.csv"), stop_at == 15);
    EXPECT_FALSE(fs::exists(place.folder / "theory.csv"));
  }
  Stopper to_the_end;
  const auto tested = all(c, place, to_the_end);
  EXPECT_EQ(undisturbed.tests().size(), 2);
  EXPECT_EQ(to_the_end.tests(), std::vector<std::string>{"compaction 0.02"});  // the first panel is not tested again
  EXPECT_EQ(moduli(tested), moduli(expected));
  const auto there = results(place.folder), wanted = results(folder / "undisturbed");
  for (const auto& [name, bytes] : wanted) {
    ASSERT_TRUE(there.contains(name)) << name;
    EXPECT_TRUE(there.at(name) == bytes) << name;
  }
  EXPECT_EQ(there.size(), wanted.size());
}

// The steps without a folder give what the journey gives, bit for bit, and leave nothing where they run.
TEST(StepsInMemory, GiveTheSameAndWriteNothing) {
  const auto c = small_case();
  const TemporaryFolder folder;
  const auto before = fs::current_path();
  fs::create_directory(folder / "empty");
  fs::current_path(folder / "empty");
  Observer nobody;
  const auto formed = form(c);
  const auto pressed = press(formed, nobody);
  const auto tested = test(formed, pressed.panels, nobody);
  fs::current_path(before);
  EXPECT_TRUE(fs::is_empty(folder / "empty"));
  ASSERT_EQ(pressed.panels.size(), 2);
  EXPECT_FALSE(pressed.outcome.records.empty());
  EXPECT_EQ(moduli(tested), moduli(all(c, {folder / "run"}, nobody)));
}

// A finished journey gives its tests again from the folder.
TEST(FinishedRun, GivesItsTestsAgain) {
  const auto c = small_case();
  const TemporaryFolder folder;
  Observer nobody;
  const auto first = all(c, {folder / "run"}, nobody);
  Stopper asked;
  const auto again = all(c, {folder / "run"}, asked);
  EXPECT_EQ(asked.asked(), 0);
  EXPECT_EQ(to_json(again), to_json(first));
}

}  // namespace
}  // namespace strandlab::run
