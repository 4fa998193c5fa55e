// Finished run folders side by side: replicates of each case together, cases against the first.
#pragma once

#include <string>
#include <vector>

#include "strandlab/files/csv.hpp"
#include "strandlab/study/observations.hpp"

namespace strandlab::study {

struct Comparison {
  struct Group {
    std::string name;
    std::vector<std::string> runs;     // folders
    std::vector<Finding> moduli;       // of these runs
    std::vector<Finding> differences;  // from the first group, paired by seed; none of the first
  };
  std::vector<Group> groups;  // in the order of their first runs
};

// Runs of one case but for run.seed and mat.file are a group; a group is named as its case, with the keys that differ
// where that does not tell groups apart. Throws InputError for a folder that holds no finished run, and for a panel
// given twice.
Comparison compare_runs(const std::vector<std::string>& folders);

// A row per group and modulus, then per difference: contrast ("" or "a - b"), case, compaction, test,
// compliance_t_mm_per_MPa, n, mean_MPa, sd_MPa, low_MPa, high_MPa, reference_MPa, state, density_kg_m3.
files::CsvTable table_of(const Comparison& comparison);

// The same for people.
std::string text_of(const Comparison& comparison);

}  // namespace strandlab::study
