// What a user may choose of the virtual tests.
#pragma once

#include <vector>

#include "strandlab/core/declaration.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::vtest {

std::vector<Declaration<Options>> bond_options();  // the glue lines' compliances
std::vector<Declaration<Options>> test_options();

}  // namespace strandlab::vtest
