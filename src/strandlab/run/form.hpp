// The first step: the mat of a case, and the panel it makes before pressing.
#pragma once

#include "strandlab/case/case.hpp"

namespace strandlab::run {

// What the other steps start from.
struct Formed {
  cases::Case c;  // with the compactions at which this mat has the states asked for
  mat::Mat mat;
  Panel<2> panel;
};

// Forms (or reads) the mat. Throws InputError for a mat that cannot be formed or read, does not fit into memory, or
// that the tests of the case could not be made of.
Formed form(cases::Case c);

// Refuses a mat that no glue can connect from end to end: pressed, there would be nothing to test. Throws InputError.
void refuse_untestable(const Formed& formed);

}  // namespace strandlab::run
