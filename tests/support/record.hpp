// What support/report.hpp does, under a name that the namespace strandlab::report does not hide.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace strandlab::test {

// `measured` in `unit` ("" for a ratio); `allowed` as a reader of the book wants to see it.
inline void record(const std::string& what, double measured, const std::string& allowed, const std::string& unit = "") {
  char number[32];
  std::snprintf(number, sizeof number, "%.4g", measured);
  testing::Test::RecordProperty("report:" + what, std::string(number) + "\t" + unit + "\t" + allowed);
}

}  // namespace strandlab::test
