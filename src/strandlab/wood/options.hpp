// The constants of a material that a user may change.
#pragma once

#include <vector>

#include "strandlab/core/declaration.hpp"
#include "strandlab/wood/material.hpp"

namespace strandlab::wood {

// Density and elastic constants, then those of each law (laws/list.hpp).
std::vector<Declaration<Material>> material_options();

}  // namespace strandlab::wood
