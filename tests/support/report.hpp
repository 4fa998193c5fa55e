// Numbers for docs/verification.md. A verification test states what it measured and holds it against a limit:
//
//   report("period of the first mode, 40 cells, against 2 L/c", error, within(1e-3));
//   report("tension modulus, 1/D_t = 0.0021 mm/MPa, over the reference", ratio, near(1, 0.01));
//   report("energy balance over the platens' work", worst, below(1e-3).because("the press warns from .01 on"));
//   report("friction work", work, near(3.12, 0.06), "mJ");
//
// The number reported is the number judged: no EXPECT_* beside it. scripts/verification runs the tests and writes what
// they reported, in this order, to docs/verification.md; it refuses limits of more than ten times the measured number
// without a reason, and two sentences that are equal.
#pragma once

#include "support/record.hpp"

namespace strandlab {

using test::above, test::below, test::between, test::near, test::within;

// As test::record().
inline void report(const std::string& what, double measured, const test::Limit& limit, const std::string& unit = "",
                   const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  test::record(what, measured, limit, unit, file, line);
}

// For what no single limit says: `allowed` in words, and EXPECT_* beside it judges.
inline void report(const std::string& what, double measured, const std::string& allowed, const std::string& unit = "") {
  test::record(what, measured, allowed, unit);
}

}  // namespace strandlab
