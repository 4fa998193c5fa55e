// What a mat is made of, in words.
#pragma once

#include <string>
#include <vector>

#include "strandlab/panel/panel.hpp"

namespace strandlab::run {

// Weight of panel area, and the percentages of it by strand kind and by material.
std::vector<std::string> composition(const Weight& weight);

}  // namespace strandlab::run
