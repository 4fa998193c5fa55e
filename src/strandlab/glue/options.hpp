// What a user may choose of the curing.
#pragma once

#include <vector>

#include "strandlab/core/declaration.hpp"
#include "strandlab/glue/glue.hpp"

namespace strandlab::glue {

std::vector<Declaration<CuringOptions>> curing_options();

}  // namespace strandlab::glue
