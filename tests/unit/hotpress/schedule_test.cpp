// Press schedules in words, and what is wrong with some.
#include "strandlab/hotpress/schedule.hpp"

#include <gtest/gtest.h>

#include "strandlab/core/error.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::hotpress {
namespace {

std::string refusal(const std::vector<std::string>& texts) {
  return test::message_of<InputError>([&] { parse_schedule(texts); });
}

void expect_refusal(const std::vector<std::string>& texts, const std::string& part) {
  const auto message = refusal(texts);
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(Schedule, PhasesInWords) {
  const auto close = parse_phase("close to 12 mm in 25 s");
  EXPECT_EQ(close.kind, Phase::Kind::kClose);
  EXPECT_DOUBLE_EQ(close.target->value, .012);
  EXPECT_DOUBLE_EQ(*close.seconds, 25);
  const auto speed = parse_phase("close to 640kg/m3 at 0.5 mm/s");
  EXPECT_EQ(speed.target->kind, Target::Kind::kDensity);
  EXPECT_DOUBLE_EQ(*speed.speed, 5e-4);
  const auto pressure = parse_phase("close at 4 MPa to 45 %, within 1 min");
  EXPECT_EQ(pressure.target->kind, Target::Kind::kCompaction);
  EXPECT_DOUBLE_EQ(pressure.target->value, .45);
  EXPECT_DOUBLE_EQ(*pressure.pressure, 4e6);
  EXPECT_DOUBLE_EQ(*pressure.seconds, 60);
  const auto hold = parse_phase("hold from 25 s until 240 s at 3 MPa to 11.5 mm");
  EXPECT_DOUBLE_EQ(*hold.from, 25);
  EXPECT_DOUBLE_EQ(*hold.until, 240);
  EXPECT_DOUBLE_EQ(hold.target->value, .0115);
  EXPECT_EQ(parse_schedule(default_schedule()).size(), 4u);
}

TEST(Schedule, WhatIsWrongWithAPhase) {
  expect_refusal({"clsoe to 12 mm in 25 s"}, "did you mean close?");
  expect_refusal({"close to 12 mm"}, "closing by position needs a time in s or a speed in mm/s");
  expect_refusal({"close in 25 s"}, "closing needs a target");
  expect_refusal({"close at 4 MPa to 12 mm"}, "needs a time it may take at most");
  expect_refusal({"close to 12 mm in 25 s at 1 mm/s"}, "both a time and a speed; give one");
  expect_refusal({"close to 12 mm at 1 mm/s and 4 MPa"}, "by pressure or by position");
  expect_refusal({"close to 12 mm to 11 mm in 5 s"}, "two targets");
  expect_refusal({"close to 12 inch in 25 s"}, "\"inch\" is no unit of a schedule");
  expect_refusal({"close to 12 mm in 25"}, "25 has no unit");
  expect_refusal({"close to 12 mm in -5 s"}, "a time must be greater than 0");
  expect_refusal({"close to 0 mm in 5 s"}, "0 mm must be greater than 0");
  expect_refusal({"close slowly to 12 mm in 25 s"}, "\"slowly\" is not understood");
  expect_refusal({"close to 12 mm in 25 s", "hold"}, "phase \"hold\": needs a time in s");
  expect_refusal({"close to 12 mm in 25 s", "hold 10 s until 60 s"}, "both a duration and a time to end at");
  expect_refusal({"close to 12 mm in 25 s", "hold 10 s to 12 mm"}, "only closing, or holding a pressure, has a target");
  expect_refusal({"close to 12 mm in 25 s", "hold 10 s at 1 mm/s"}, "only closing has a speed");
  expect_refusal({"close to 12 mm in 25 s", "vent 10 s at 1 MPa"}, "only closing and holding have a pressure");
}

TEST(Schedule, OrderAndOverlap) {
  expect_refusal({}, "a schedule begins with closing");
  expect_refusal({"hold 10 s"}, "a schedule begins with closing");
  expect_refusal({"close to 12 mm in 25 s", "open 10 s", "hold 5 s"}, "comes after opening, which is the last phase");
  expect_refusal({"close to 12 mm in 25 s", "vent 10 s", "hold 5 s"}, "after venting only opening follows");
  expect_refusal({"close to 12 mm in 25 s", "hold until 20 s"},
                 "phases overlap: it ends at 20 s, the one before it at 25 s");
  expect_refusal({"close to 12 mm in 25 s", "hold from 20 s until 90 s"},
                 "phases overlap: it begins at 20 s, the one before it ends at 25 s");
  expect_refusal({"close to 12 mm in 25 s", "hold from 30 s until 90 s"},
                 "it begins at 30 s, but the one before it ends at 25 s");
}

const MatSize kSize{7.68, .025, 7.68 / 350, 7.68 / 1500};

TEST(Schedule, TargetsAsThickness) {
  EXPECT_DOUBLE_EQ(thickness_of({Target::Kind::kThickness, .012}, kSize), .012);
  EXPECT_DOUBLE_EQ(thickness_of({Target::Kind::kDensity, 640}, kSize), .012);
  EXPECT_DOUBLE_EQ(thickness_of({Target::Kind::kCompaction, .4}, kSize), .015);
}

TEST(Schedule, TargetsThatAreNeverReached) {
  const auto message = [](const std::vector<std::string>& texts) {
    return test::message_of<InputError>([&] { check_targets(parse_schedule(texts), kSize); });
  };
  check_targets(parse_schedule({"close to 14 mm in 10 s", "hold 20 s", "close to 12 mm in 10 s"}), kSize);
  EXPECT_EQ(message({"close to 22 mm in 25 s"}),
            "phase \"close to 22 mm in 25 s\": 22 mm is never reached by closing: the mat is 21.94 mm before it");
  EXPECT_EQ(message({"close to 12 mm in 25 s", "close to 13 mm in 5 s"}),
            "phase \"close to 13 mm in 5 s\": 13 mm is never reached by closing: the mat is 12 mm before it");
  EXPECT_EQ(
      message({"close to 5 mm in 25 s"}),
      "phase \"close to 5 mm in 25 s\": 5 mm is never reached: the cell walls of this mat (7.68 kg/m2 of dry wood) "
      "alone are 5.12 mm");
}

TEST(Schedule, PointsJoinedByStraightLines) {
  const auto points = parse_points("0 200, 60: 190");
  EXPECT_DOUBLE_EQ(interpolated(points, -5), 200);
  EXPECT_DOUBLE_EQ(interpolated(points, 30), 195);
  EXPECT_DOUBLE_EQ(interpolated(points, 90), 190);
  for (const char* bad : {"", "0", "0 200, 0 190", "0 200 3", "a 200", "60 200, 0 190"}) {
    EXPECT_NE(test::message_of<InputError>([&] { parse_points(bad); }).find("must be pairs of numbers"),
              std::string::npos)
        << bad;
  }
}

}  // namespace
}  // namespace strandlab::hotpress
