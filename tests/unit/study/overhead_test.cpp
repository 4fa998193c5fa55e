// What a study costs beyond the work of its items.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <string>

#include "child.hpp"
#include "samples.hpp"
#include "strandlab/run/press.hpp"
#include "strandlab/run/test.hpp"
#include "strandlab/study/collect.hpp"
#include "strandlab/study/runner.hpp"

namespace strandlab::study {
namespace {

template <class Act>
double seconds_of(const Act& act) {
  const auto begin = std::chrono::steady_clock::now();
  act();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// 500 items one after another, planned, run and collected, against the same 500 panels formed, pressed and tested in
// memory. The disk's syncs are in it.
TEST(StudyOverhead, NightlyOf500Items) {
  const test::TemporaryFolder folder;
  constexpr int kItems = 500;
  run::Observer nobody;
  const double whole = seconds_of([&] {
    const auto study = small_study("replicates = 500\n", folder.path());
    EXPECT_TRUE(run_items(study, {1, 0, Keep::kModuli}, nobody).empty());
    EXPECT_EQ(collect(study).whole, 500U);
  });
  in_another_process([&] {
    const double work = seconds_of([&] {
      for (int seed = 1; seed <= kItems; ++seed) {
        const auto formed = run::form(cases::read_case(folder / "small.toml", {"run.seed=" + std::to_string(seed)}));
        run::test(formed, run::press(formed, nobody).panels, nobody);
      }
    });
    test::put(folder / "work", std::to_string(work));
  });
  const double work = std::stod(test::contents(folder / "work"));
  std::printf("%.1f s, of which %.1f s are work\n", whole, work);
  EXPECT_LT(1e3 * (whole - work) / kItems, 50);  // ms; measured: see docs/studies.md
}

}  // namespace
}  // namespace strandlab::study
