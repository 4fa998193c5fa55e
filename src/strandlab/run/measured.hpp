// Measured density profiles beside a run's own.
#pragma once

#include <filesystem>
#include <vector>

#include "strandlab/profile/measured.hpp"

namespace strandlab::run {

// All specimens of some densitometer tables; of several tables each is named after its file too. Throws as
// profile::read_measured().
std::vector<profile::Specimen> read_specimens(const std::vector<std::filesystem::path>& files,
                                              const profile::MeasuredColumns& columns = {});

// Keeps them in a run folder as measured.csv, in place of those kept before, with their mean as the last specimen where
// there are several: its page draws that one. Throws InputError for a folder that holds no run, and as
// read_specimens(), in which case the folder stays as it was.
void keep_measured(const std::filesystem::path& run_folder, const std::vector<std::filesystem::path>& files);

}  // namespace strandlab::run
