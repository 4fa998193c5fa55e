// The tables of a study.
#pragma once

#include <string>
#include <vector>

#include "strandlab/study/effects.hpp"
#include "strandlab/study/folder.hpp"
#include "strandlab/study/observations.hpp"
#include "strandlab/study/runner.hpp"

namespace strandlab::study {

struct Collected {
  std::size_t whole = 0, all = 0;           // items
  std::vector<Failure> failures;            // items that failed and are not whole
  std::vector<std::string> untestable;      // states of whole items without moduli, in words
  std::vector<const Item*> items;           // of the study, that are whole
  std::vector<std::vector<Finding>> cells;  // by cell
  std::vector<Effect> effects;              // main effects
};

// Writes into the study's folder, of the items that are whole: results.csv (a row per item, state, test and glue),
// profiles.csv and press.csv (of their pressings), summary.csv (per cell, and the plan's contrasts), effects.csv (main
// effects); docs/files.md has every column. The same results give the same bytes, whoever ran them in whichever order.
// Throws as files::write_atomically().
Collected collect(const Study& study);

}  // namespace strandlab::study
