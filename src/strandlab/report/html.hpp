// report.html: the page that the front end (web/) was bundled into, filled with the data of a run.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "strandlab/report/sheet.hpp"

namespace strandlab::report {

// The empty page: report.html of the folder in the environment variable STRANDLAB_SHARE where it is set; else the one
// built into the program; else share/strandlab/report.html beside the program's bin folder. Throws InputError, which
// says how to get it, when there is none.
std::string empty_page();

// The page with its title, its sheet as HTML and its data. The data go into an element that holds text only and every
// '<' is escaped: whatever the names in a run are, they stay text, as in the sheet. Throws InputError for a page
// without a place for one of them.
std::string filled_page(const std::string& page, const Sheet& sheet, const nlohmann::json& data);

}  // namespace strandlab::report
