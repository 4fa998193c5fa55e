// What a user may choose of the press and its grid.
#pragma once

#include <vector>

#include "strandlab/core/declaration.hpp"
#include "strandlab/press/press.hpp"

namespace strandlab::press {

std::vector<Declaration<Schedule>> schedule_options();  // but its compactions, which follow from the mat's states
std::vector<Declaration<Resolution>> resolution_options();

}  // namespace strandlab::press
