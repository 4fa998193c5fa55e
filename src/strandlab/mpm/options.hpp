// What a user may choose of the engine.
#pragma once

#include <string>
#include <vector>

#include "strandlab/core/declaration.hpp"
#include "strandlab/mpm/engine.hpp"

namespace strandlab::mpm {

const char* name(Side side);  // "roller", "free"
std::vector<std::string> side_names();
Side side_from_name(const std::string& text);  // of these names

std::vector<Declaration<Options>> contact_options();
std::vector<Declaration<Options>> step_options();  // of the time step and the filter

}  // namespace strandlab::mpm
