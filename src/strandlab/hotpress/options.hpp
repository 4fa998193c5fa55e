// What a user may choose of the softening in the hot press and of the record of a press to follow.
#pragma once

#include <vector>

#include "strandlab/core/declaration.hpp"
#include "strandlab/hotpress/log.hpp"
#include "strandlab/hotpress/softening.hpp"

namespace strandlab::hotpress {

std::vector<Declaration<Softening>> softening_options();
std::vector<Declaration<LogColumns>> log_column_options();

}  // namespace strandlab::hotpress
