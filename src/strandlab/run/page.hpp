// report.html of a run folder, and what it shows of the run.
#pragma once

#include <filesystem>
#include <vector>

#include "strandlab/panel/panel.hpp"

namespace strandlab::run {

// The frames of a pressing that a run folder holds, by compaction; of a folder without, its panels in their place.
// Throws InputError naming the file for one that cannot be used.
std::vector<Panel<2>> read_frames(const std::filesystem::path& run_folder);

// Writes the report to `out` (empty: report.html in the run folder) and returns the file; who owns the folder records
// it there. Its data are {"format": 2, "run": {"case", "case_text", "record" (run.json), "mat" (mat.json), "words"
// (what names and compliances in the tables are called: {"tests": {name: label}, "quantities": {name: {"title", "axis",
// "factor"}}, "glues": [{"compliance_t_mm_per_MPa", "name"}...]}), "tables" (file name -> CSV text), "frames"
// (report::pack_frames)}}; steps that are not done yet leave out their tables and frames. Throws as
// report::empty_page() and files::write_atomically(), and InputError naming the folder or file for a folder that holds
// no run or for a file that cannot be used.
std::filesystem::path write_report_page(const std::filesystem::path& run_folder, const std::filesystem::path& out = {});

// The same for a folder that nobody owns at the moment: its own page is recorded there. Throws also as write_page().
std::filesystem::path remake_page(const std::filesystem::path& run_folder, const std::filesystem::path& out = {});

}  // namespace strandlab::run
