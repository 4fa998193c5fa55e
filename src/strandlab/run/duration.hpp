#pragma once

#include <string>

namespace strandlab::run {

// "45 s", "3 min 20 s", "2 h 5 min".
std::string duration(double seconds);

}  // namespace strandlab::run
