#pragma once

#include <filesystem>

namespace strandlab::app {

// Writes the report of a run folder to `out` (empty: report.html in the run folder) and returns the file; who owns the
// folder records it there. Throws as report::empty_page(), run::report_data() and files::write_atomically().
std::filesystem::path write_report_page(const std::filesystem::path& run_folder, const std::filesystem::path& out = {});

}  // namespace strandlab::app
