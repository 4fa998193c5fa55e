// Logs of a press's controller.
#include "strandlab/hotpress/log.hpp"

#include <gtest/gtest.h>

#include "strandlab/core/error.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::hotpress {
namespace {

std::string refusal(const std::string& text, const LogColumns& columns = {}) {
  return test::message_of<InputError>([&] { log_from_text(text, "plc.csv", columns); });
}

TEST(Log, ColumnsByUsualNames) {
  const auto log = log_from_text(
      "Time (s),Position (mm),Pressure (bar),Top (C),Bottom (C)\n0,25,0,200,198\n10,12,40,199,197\n", "plc.csv");
  ASSERT_EQ(log.position.size(), 2u);
  EXPECT_DOUBLE_EQ(log.position[1].at, 10);
  EXPECT_DOUBLE_EQ(log.position[1].value, .012);
  EXPECT_DOUBLE_EQ(log.pressure[1].value, 4e6);
  EXPECT_DOUBLE_EQ(log.platen_top[0].value, 200);
  EXPECT_DOUBLE_EQ(log.platen_bottom[1].value, 197);
}

// Minutes, semicolons, decimal commas; a column by its name, one by its number, with a unit the header does not state.
TEST(Log, ColumnsByNameAndNumber) {
  const auto log =
      log_from_text("t [min];Weg 1;P\n0,0;25,0;0\n0,5;12,5;3,2\n", "plc.csv", {"", "Weg 1 mm", "3 MPa", "", ""});
  EXPECT_DOUBLE_EQ(log.position[1].at, 30);
  EXPECT_DOUBLE_EQ(log.position[1].value, .0125);
  EXPECT_DOUBLE_EQ(log.pressure[1].value, 3.2e6);
  EXPECT_TRUE(log.platen_top.empty());
}

// One column of platen temperatures holds for both; a missing reading is passed over.
TEST(Log, OnePlatenTemperatureForBothSides) {
  const auto log = log_from_text("time_s,gap_mm,platen_C\n0,25,200\n5,-,199\n10,12,198\n", "plc.csv");
  EXPECT_EQ(log.position.size(), 2u);
  EXPECT_EQ(log.platen_bottom.size(), 3u);
}

TEST(Log, TimeRunningBackwards) {
  EXPECT_EQ(refusal("time_s,gap_mm\n0,25\n10,12\n9,12\n"),
            "plc.csv:4: time 9 s after 10 s; a log goes forward in time");
}

TEST(Log, WhatMovesThePressIsThere) {
  EXPECT_EQ(refusal("time_s,top_C\n0,200\n10,200\n"),
            "plc.csv: neither a column of position (mm) nor one of pressure (MPa, bar); one of them moves the press");
  EXPECT_EQ(refusal("time_s,gap_mm\n0,25\n"), "plc.csv: one reading of position is no record of a press");
}

TEST(Log, NamesUnitsAndNumbers) {
  EXPECT_NE(refusal("clock_s,gap_mm\n0,25\n1,24\n").find("missing column time"), std::string::npos);
  EXPECT_NE(refusal("time_s,gap\n0,25\n1,24\n").find("has no unit"), std::string::npos);
  EXPECT_NE(refusal("time_s,gap_mm\n0,25\n1,24\n", {"", "7 mm", "", "", ""}).find("no column 7"), std::string::npos);
  EXPECT_NE(refusal("time_s,gap_mm\n0,25\n1,x\n").find("plc.csv:3"), std::string::npos);
}

}  // namespace
}  // namespace strandlab::hotpress
