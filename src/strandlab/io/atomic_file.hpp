// Files that are either the old one or the new one, never half of either.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace strandlab::io {

// Writes `file` through a temporary file in the same folder ("<file>.tmp"): `fill` writes the temporary, which is then
// synced to disk and renamed over `file`. Whatever happens before the rename leaves `file` as it was; a leftover
// temporary file of a killed run is overwritten. Throws InputError where the folder does not exist or may not be
// written, RunError when the disk is full or fails; what `fill` throws passes through, and the temporary file is
// removed.
void replace_atomically(const std::filesystem::path& file,
                        const std::function<void(const std::filesystem::path& temporary)>& fill);

// The same for text or bytes in memory.
void write_atomically(const std::filesystem::path& file, std::string_view bytes);

}  // namespace strandlab::io
