// Programs that strandlab starts or that people use beside it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace strandlab::run {

// Where the PATH has a program of this name.
std::optional<std::filesystem::path> installed(const std::string& program);

}  // namespace strandlab::run
