// Files that are either the old one or the new one, never half of either.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace strandlab {

// Writes `file` through a temporary file in the same folder ("<file>.tmp") that is synced to disk and renamed over
// `file`. Whatever happens before the rename leaves `file` as it was; a leftover temporary file of a killed run is
// overwritten. `before_rename`, where given, is called when the new file is safe on disk under its temporary name.
// Throws InputError where the folder does not exist or may not be written, RunError when the disk is full or fails;
// what `before_rename` throws passes through. The temporary file is then removed.
void write_atomically(const std::filesystem::path& file, std::string_view bytes,
                      const std::function<void()>& before_rename = nullptr);

}  // namespace strandlab
