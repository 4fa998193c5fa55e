// What report.html shows of a run, read back from its run folder.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "strandlab/panel/panel.hpp"

namespace strandlab::run {

// {"format": 1, "run": {"case", "case_text", "record" (run.json), "mat" (mat.json), "findings"
// ([{"level", "text"}...], warnings first), "words" (what names in the tables are called: {"tests": {name: label},
// "quantities": {name: {"title", "axis", "factor"}}}), "tables" (file name -> CSV text), "frames"
// (report::pack_frames)}}. Steps that are not done yet leave out their tables and frames. Throws InputError naming the
// folder or file for a folder that holds no run or for a file that cannot be used.
nlohmann::json report_data(const std::filesystem::path& run_folder);

// The frames of a pressing that a run folder holds, by compaction; of a folder without, its panels in their place.
// Throws InputError as report_data().
std::vector<Panel<2>> read_frames(const std::filesystem::path& run_folder);

}  // namespace strandlab::run
