// Files that are either the old one or the new one, never half of either.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace strandlab::files {

// Writes `file` through a temporary file of its own in the same folder, which is synced to disk and renamed over
// `file`: of several that write the same file at once the last one stays, whole. Whatever happens before the rename
// leaves `file` as it was. `before_rename`, where given, is called when the new file is safe on disk under its
// temporary name. Throws InputError where the folder does not exist or may not be written, RunError when the disk is
// full or fails; what `before_rename` throws passes through. The temporary file is then removed.
void write_atomically(const std::filesystem::path& file, std::string_view bytes,
                      const std::function<void()>& before_rename = nullptr);

// Makes a folder for results, with those above it; one that is there stays. Throws InputError where that cannot be.
void make_folder(const std::filesystem::path& folder);

// A name beside `file` that no other thread or running process of this machine uses: "<file>.<process>-<number>.tmp".
std::filesystem::path temporary_name(const std::filesystem::path& file);

// Whether a file has such a name: what a killed program leaves.
bool is_temporary(const std::filesystem::path& file);

// Removes the temporary files in `folder`, not below it, that were made by processes of this machine which run no more
// and whose name begins with `name`. For folders in which several programs write at once: what they still write stays.
void remove_abandoned(const std::filesystem::path& folder, std::string_view name = "");

}  // namespace strandlab::files
