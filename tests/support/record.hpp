// What support/report.hpp does, under a name that the namespace strandlab::report does not hide.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "support/limit.hpp"

namespace strandlab::test {

// One row of the book: `measured` in `unit` ("" for a ratio), `allowed` as a reader wants to see it; judges nothing,
// for what no single limit says ("falls with the cells"). `slack` and `reason` as Limit has them. Fails where the test
// has reported the same sentence before.
inline void record(const std::string& what, double measured, const std::string& allowed, const std::string& unit = "",
                   double slack = 1, const std::string& reason = "", int digits = 4) {
  const std::string key = "report:" + what;
  const auto& result = *testing::UnitTest::GetInstance()->current_test_info()->result();
  for (int i = 0; i < result.test_property_count(); ++i) {
    if (result.GetTestProperty(i).key() == key) ADD_FAILURE() << "reported twice: " << what;
  }
  testing::Test::RecordProperty(
      key, number(measured, digits) + "\t" + unit + "\t" + allowed + "\t" + number(slack) + "\t" + reason);
}

// Holds `measured` against the limit and writes both into the book: what the book says is what the test enforces.
inline void record(const std::string& what, double measured, const Limit& limit, const std::string& unit = "",
                   const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  record(what, measured, limit.text(), unit, limit.slack(measured), limit.reason(), limit.digits());
  if (!limit.holds(measured)) {
    ADD_FAILURE_AT(file, line) << what << ": " << measured << " " << unit << ", allowed: " << limit.text();
  }
}

}  // namespace strandlab::test
