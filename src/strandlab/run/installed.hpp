// Programs that strandlab starts or that people use beside it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace strandlab::run {

// Where the PATH has a program of this name.
std::optional<std::filesystem::path> installed(const std::string& program);

// The first line that a program prints when it is called with these arguments of the shell, "--version", without what
// follows "Copyright"; at most 100 characters. Empty for one that prints nothing within three seconds.
std::string first_line_of(const std::filesystem::path& program, const std::string& arguments);

}  // namespace strandlab::run
