// Text files that are either complete or absent.
#pragma once

#include <filesystem>
#include <string_view>

namespace strandlab {

// Writes `text` to a neighbouring temporary file and renames it to `file`, so that no half-written file is ever seen
// under that name, not even after a kill. Throws InputError (file, reason) without a folder, permission or space;
// `file` is then as it was.
void write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace strandlab
