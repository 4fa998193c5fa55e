// Result files of the hot press.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "strandlab/files/csv.hpp"
#include "strandlab/hotpress/answers.hpp"

namespace strandlab::report {

// hotpress.csv: one line per step. M are kg of water per kg of dry wood; gas pressures are above the room's. Face: mean
// of both outermost cells; quarter: of the two cells a quarter of the mass from the faces; core: the cell next to
// mid-mass; cure_face and cure_core are of each resin in the least cured of the layers that carry it.
files::CsvTable hotpress_table(const hotpress::Cycle& cycle);

// transfer_profiles.csv: through the thickness at about a hundred times and at the ends of closing, hold and opening.
files::CsvTable profiles_table(const hotpress::Cycle& cycle);

// transfer_section.csv: all cells of a section of several columns, at about twenty times and at those ends.
files::CsvTable section_table(const hotpress::Cycle& cycle);

// Writes these tables into a folder; transfer_section.csv where there are several columns, else none is left there.
void write_hotpress_tables(const hotpress::Cycle& cycle, const std::filesystem::path& folder);

// What run.json has under `hotpress`; null for what the cycle does not reach.
nlohmann::json to_json(const hotpress::Band& band);

// The same in a few lines: how long must I press?
std::vector<std::string> summary(const hotpress::Band& band);

}  // namespace strandlab::report
