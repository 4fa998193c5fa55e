// What a study costs beyond the work of its items.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <utility>

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
    const auto study = small_study("[axes]\npress.speed_m_s = {from = 16, to = 32, count = 500}\n", folder.path());
    EXPECT_TRUE(run_items(study, {1, 0, Keep::kModuli}, nobody).empty());
    EXPECT_EQ(collect(study).whole, 500U);
  });
  const auto study = open_study(folder / "study");
  in_another_process([&] {
    const double work = seconds_of([&] {
      for (const auto& item : study.items) {
        auto c = read_item_case(study, item);
        c.threads = 0;  // all cores, as a single worker has them
        const auto formed = run::form(std::move(c));
        run::test(formed, run::press(formed, nobody).panels, nobody);
      }
    });
    test::put(folder / "work", std::to_string(work));
  });
  const double work = std::stod(test::contents(folder / "work"));
  std::printf("%.1f s, of which %.1f s are work\n", whole, work);
  EXPECT_LT(1e3 * (whole - work) / kItems, 50);  // ms; measured: MEASURED
}

}  // namespace
}  // namespace strandlab::study
