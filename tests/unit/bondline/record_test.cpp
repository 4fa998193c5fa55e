#include "strandlab/bondline/record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "strandlab/core/error.hpp"
#include "strandlab/core/random.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::bondline {
namespace {

constexpr double kStiffness = 2500;  // N/mm

// Load 0 to 500 N in 1 N steps on a straight line of 2500 N/mm, with normal noise of the displacement.
std::vector<LoadPoint> straight(double noise_mm, std::uint64_t stream = 0) {
  RandomStream random(7, stream);
  std::vector<LoadPoint> record;
  for (int load = 0; load <= 500; ++load)
    record.push_back({static_cast<double>(load), load / kStiffness + noise_mm * random.normal()});
  return record;
}

TEST(Record, StraightLineIsExact) {
  const Slope slope = fit_stiffness(straight(0), {});
  EXPECT_NEAR(slope.stiffness_N_per_mm, kStiffness, 1e-9 * kStiffness);
  EXPECT_NEAR(slope.r_squared, 1, 1e-12);
  EXPECT_EQ(slope.low_N, 50);
  EXPECT_EQ(slope.high_N, 200);
  EXPECT_EQ(slope.points, 151);
  EXPECT_NEAR(slope.toe_mm, 0, 1e-12);
  EXPECT_TRUE(slope.flags.empty());
  EXPECT_TRUE(slope.problem.empty());
}

TEST(Record, WindowInNewton) {
  const Slope slope = fit_stiffness(straight(0), {100, 300, false});
  EXPECT_EQ(slope.points, 201);
  EXPECT_NEAR(slope.stiffness_N_per_mm, kStiffness, 1e-6);
}

// The stated standard error must describe the scatter of the slope from record to record: 300 records, so the ratio of
// the two is known to 4 %.
TEST(Record, StandardErrorDescribesTheScatter) {
  double sum = 0, squares = 0, stated = 0;
  constexpr int kRecords = 300;
  for (int i = 0; i < kRecords; ++i) {
    const Slope slope = fit_stiffness(straight(.001, static_cast<std::uint64_t>(i)), {});
    sum += slope.stiffness_N_per_mm;
    squares += std::pow(slope.stiffness_N_per_mm - kStiffness, 2);
    stated += slope.standard_error / kRecords;
    EXPECT_TRUE(slope.flags.empty()) << slope.flags.front();
  }
  const double scatter = std::sqrt(squares / kRecords);
  EXPECT_NEAR(sum / kRecords, kStiffness, 3 * scatter / std::sqrt(kRecords));
  EXPECT_NEAR(stated / scatter, 1, .15);
}

// A tenth of the readings off by up to 100 times the noise: the slope moves by no more than a few of its standard
// errors; least squares would be off by ten times as much.
TEST(Record, OutliersDoNotMoveTheSlope) {
  auto record = straight(.0005);
  for (std::size_t i = 5; i < record.size(); i += 10)
    record[i].displacement_mm += .05 * (static_cast<double>(i) / 500 - .5);
  const Slope slope = fit_stiffness(record, {});
  EXPECT_NEAR(slope.stiffness_N_per_mm, kStiffness, 4 * slope.standard_error);
  EXPECT_LT(slope.standard_error, .01 * kStiffness);
}

TEST(Record, OnlyTheRisingBranchCounts) {
  auto record = straight(0);
  for (int load = 499; load >= 0; --load) record.push_back({static_cast<double>(load), .3 + load / 1000.0});
  EXPECT_NEAR(fit_stiffness(record, {}).stiffness_N_per_mm, kStiffness, 1e-6);
}

// A toe takes up .05 mm below 20 N; the line above it is untouched.
TEST(Record, ToeBelowTheWindowIsMeasuredNotFlagged) {
  auto record = straight(.0002);
  for (auto& point : record) point.displacement_mm += .05 * (1 - std::exp(-point.load_N / 5));
  const Slope slope = fit_stiffness(record, {});
  EXPECT_NEAR(slope.toe_mm, .05, .001);
  EXPECT_TRUE(slope.flags.empty());
  EXPECT_NEAR(slope.stiffness_N_per_mm, kStiffness, .01 * kStiffness);
}

TEST(Record, ToeInsideTheWindowIsFlagged) {
  auto record = straight(.0002);
  for (auto& point : record) point.displacement_mm += .05 * (1 - std::exp(-point.load_N / 60));
  const Slope slope = fit_stiffness(record, {});
  ASSERT_EQ(slope.flags.size(), 1U);
  EXPECT_EQ(slope.flags[0].substr(0, 4), "toe:");
}

TEST(Record, DisplacementJumpIsFlagged) {
  auto record = straight(.0002);
  for (auto& point : record)
    if (point.load_N > 120) point.displacement_mm += .01;
  const Slope slope = fit_stiffness(record, {});
  ASSERT_FALSE(slope.flags.empty());
  EXPECT_EQ(slope.flags.back().substr(0, 5), "slip:");
  EXPECT_NE(slope.flags.back().find("at 120 N"), std::string::npos) << slope.flags.back();
}

TEST(Record, LoadDropIsFlagged) {
  std::vector<LoadPoint> record;
  for (int i = 0; i <= 600; ++i) record.push_back({static_cast<double>(i < 120 ? i : i - 30), i / kStiffness});
  const Slope slope = fit_stiffness(record, {});
  ASSERT_FALSE(slope.flags.empty());
  EXPECT_EQ(slope.flags.back(), "slip: the load drops at 119 N");
}

TEST(Record, UselessRecordsSayWhy) {
  EXPECT_NE(fit_stiffness({}, {}).problem.find("no load above zero"), std::string::npos);
  EXPECT_NE(fit_stiffness({{-5, .1}, {-3, .2}}, {}).problem.find("no load above zero"), std::string::npos);
  EXPECT_NE(fit_stiffness({{0, 0}, {100, .1}, {200, .2}}, {}).problem.find("only 0 points"), std::string::npos);
  EXPECT_NE(fit_stiffness(straight(0), {100, 900, false}).problem.find("the load reaches 500 N"), std::string::npos);
  std::vector<LoadPoint> stuck;
  for (int load = 0; load <= 500; ++load) stuck.push_back({static_cast<double>(load), .1});
  EXPECT_NE(fit_stiffness(stuck, {}).problem.find("does not grow"), std::string::npos);
}

TEST(Record, WindowsOutOfRangeAreErrors) {
  EXPECT_THROW(validate({.4, .1, true}), InputError);
  EXPECT_THROW(validate({.1, 1.4, true}), InputError);
  EXPECT_THROW(validate({-10, 100, false}), InputError);
  EXPECT_NO_THROW(validate({10, 400, false}));
}

TEST(Record, FileOfATestingMachine) {
  const test::TemporaryFolder folder;
  const auto file = folder / "record.csv";
  std::ofstream(file) << "Specimen label;S12\r\nRate;1 mm/min\r\n\r\nTime;Extension;Load\r\n(s);(mm);(kN)\r\n"
                         "0,0;0,000;0,000\r\n0,1;0,010;0,025\r\n0,2;0,020;\r\n0,3;0,030;0,075\r\n";
  const auto record = read_record(file);
  ASSERT_EQ(record.size(), 3U);
  EXPECT_NEAR(record[1].load_N, 25, 1e-12);
  EXPECT_NEAR(record[2].displacement_mm, .03, 1e-15);
}

}  // namespace
}  // namespace strandlab::bondline
