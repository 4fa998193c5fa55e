// Whole files as text.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace strandlab::files {

// The bytes of a file; none where it cannot be opened.
std::optional<std::string> read_text(const std::filesystem::path& file);

}  // namespace strandlab::files
