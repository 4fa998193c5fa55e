// What a user should know of a case before it runs.
#pragma once

#include <string>

#include "strandlab/case/case.hpp"

namespace strandlab::run {

// The case resolved, and as comments behind it its mat, its densities, its size and what it will cost: a case file
// again. Throws InputError as form() and refuse_untestable(), for the case of a plate as form_plate().
std::string checked_text(cases::Case c);

}  // namespace strandlab::run
