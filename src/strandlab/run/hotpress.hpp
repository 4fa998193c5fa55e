// A hot press cycle through the thickness of a case's mat, in memory and into a folder.
#pragma once

#include <string>
#include <vector>

#include "strandlab/case/case.hpp"
#include "strandlab/hotpress/answers.hpp"
#include "strandlab/run/folder.hpp"
#include "strandlab/run/observer.hpp"

namespace strandlab::run {

struct HotPressed {
  hotpress::Band band;
  std::vector<std::string> notes;  // what a user should be told, warnings of the cycle among it
};

// Throws InputError as cases::hotpress_settings(), Cancelled when the observer stops it.
HotPressed hotpress(const cases::Case& c, Observer& observer);

// The same, and leaves case.toml, run.json and the tables of report::write_hotpress_tables() there. Throws InputError,
// with nothing written, for a folder of other results, or of these without `force`.
HotPressed hotpress(const cases::Case& c, const Place& place, Observer& observer);

}  // namespace strandlab::run
