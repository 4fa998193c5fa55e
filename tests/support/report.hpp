// Numbers for docs/verification.md. A verification test states what it measured and what it allows:
//
//   #include "support/report.hpp"
//   report("period of the first mode, 40 cells, against 2 L/c", error, "< 0.1 %");
//   report("tension modulus, 1/D_t = 0.0021 mm/MPa, over the reference", ratio, "1 +- 0.01");
//   report("friction work", work, "2 % of 3.12", "mJ");
//
// scripts/verification runs the tests and writes what they reported, in this order, to docs/verification.md. The
// sentence is unique within its test: it is the key of the record. Reporting judges nothing; EXPECT_* beside it does.
#pragma once

#include "support/record.hpp"

namespace strandlab {

// As test::record().
inline void report(const std::string& what, double measured, const std::string& allowed, const std::string& unit = "") {
  test::record(what, measured, allowed, unit);
}

}  // namespace strandlab
