// Lap-shear tests from a table of specimens into a folder of results.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "strandlab/bondline/analysis.hpp"

namespace strandlab::run {

// runs/<table>-bondline, where the program puts results unless it is told.
std::filesystem::path bondline_folder(const std::filesystem::path& table);

struct BondLinesWritten {
  std::vector<std::string> files;
  std::size_t plots = 0;
  std::vector<std::string> warnings;  // why pictures could not be drawn
};

// Makes the folder where it is missing and writes specimens.csv, groups.csv, comparisons.csv, <table>.json and plots.
// Throws as files::write_atomically().
BondLinesWritten write(const bondline::Analysis& analysis, const std::filesystem::path& table,
                       const std::filesystem::path& folder);

}  // namespace strandlab::run
