// Several mistakes of one input, told together.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "strandlab/core/error.hpp"

namespace strandlab {

// Each is a complete message; what() has them all.
struct InputErrors : InputError {
  explicit InputErrors(std::vector<std::string> all) : InputError(joined(all)), messages(std::move(all)) {}
  std::vector<std::string> messages;

 private:
  static std::string joined(const std::vector<std::string>& all) {
    std::string text;
    for (const auto& message : all) text += (text.empty() ? "" : "; ") + message;
    return text;
  }
};

}  // namespace strandlab
