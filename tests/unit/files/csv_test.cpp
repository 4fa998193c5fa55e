#include "strandlab/files/csv.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <stdexcept>

#include "support/temporary_folder.hpp"

namespace strandlab::files {
namespace {

TEST(Csv, HeaderThenRows) {
  CsvTable table({"compaction", "test", "count"});
  table.add_row({0.1, "tension", 3LL});
  table.add_row({0.25, "bending", -1LL});
  EXPECT_EQ(table.text(), "compaction,test,count\n0.1,tension,3\n0.25,bending,-1\n");
}

TEST(Csv, QuotesWhatWouldBreakARow) {
  CsvTable table({"name", "x,y"});
  table.add_row({"a \"b\", c", "line\nbreak"});
  EXPECT_EQ(table.text(), "name,\"x,y\"\n\"a \"\"b\"\", c\",\"line\nbreak\"\n");
}

TEST(Csv, NumbersThatAreNotFinite) {
  CsvTable table({"a", "b", "c"});
  table.add_row({std::copysign(std::numeric_limits<double>::quiet_NaN(), -1.0), HUGE_VAL, -HUGE_VAL});
  EXPECT_EQ(table.text(), "a,b,c\nnan,inf,-inf\n");
}

// Any double comes back to the same bits, and no number is longer than 17 digits need.
TEST(Csv, DoublesComeBackToTheSameBits) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t bits = random();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    CsvTable table({"v"});
    table.add_row({value});
    const std::string cell = table.text().substr(2);
    const double back = std::strtod(cell.c_str(), nullptr);
    ASSERT_EQ(std::memcmp(&back, &value, sizeof value), 0) << cell;
    ASSERT_LE(cell.size(), 25U);
  }
  CsvTable table({"v"});
  table.add_row({0.1 + 0.2});
  table.add_row({16000.0});
  EXPECT_EQ(table.text(), "v\n0.30000000000000004\n16000\n");
}

TEST(Csv, RefusesRowsThatDoNotFit) {
  CsvTable table({"a", "b"});
  EXPECT_THROW(table.add_row({1.0}), std::invalid_argument);
  EXPECT_THROW(CsvTable({"a", "a"}), std::invalid_argument);
  EXPECT_THROW(CsvTable({"a", ""}), std::invalid_argument);
}

TEST(Csv, WritesAWholeFile) {
  const test::TemporaryFolder folder;
  CsvTable table({"a"});
  table.add_row({1.5});
  table.write(folder / "t.csv");
  EXPECT_EQ(test::contents(folder / "t.csv"), "a\n1.5\n");
}

}  // namespace
}  // namespace strandlab::files
