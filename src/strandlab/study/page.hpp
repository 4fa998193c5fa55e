// report.html of a study: what its tables say, as one page.
#pragma once

#include <filesystem>
#include <vector>

#include "strandlab/study/collect.hpp"
#include "strandlab/study/folder.hpp"

namespace strandlab::study {

// Writes report.html into the study's folder, of the tables that collect() has just written there. The same results
// give the same bytes. Throws InputError where there is no page to fill (report::empty_page()), and as
// files::write_atomically().
std::filesystem::path write_page(const Study& study, const Collected& collected);

}  // namespace strandlab::study
