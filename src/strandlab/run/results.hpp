// Folders of results that are not those of a run.
#pragma once

#include <filesystem>

namespace strandlab::run {

// Throws InputError where `file`, one of the results, is there already and may not be replaced (`force`).
void refuse_results(const std::filesystem::path& file, bool force);

}  // namespace strandlab::run
