// Density profiles of pressed panels in several run folders: replicates together, beside measured ones.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/profile/measured.hpp"
#include "strandlab/profile/profile.hpp"
#include "strandlab/report/density_profiles.hpp"

namespace strandlab::run {

struct ProfileQuestion {
  std::vector<std::string> runs;      // folders
  std::vector<std::string> measured;  // exports of an X-ray densitometer; none: nothing is compared
  profile::MeasuredColumns columns;   // of these
  int bins = 0;                       // 0: each one cell of the press high
  double compaction = -1;             // to compare; below 0: the nearest in mean density
};

struct Comparison {
  std::vector<profile::Specimen> specimens;
  profile::Mean measured, simulated;  // in the same bins
};

struct ProfileAnswer {
  std::vector<report::Replicate> replicates;
  std::vector<profile::Mean> means;  // by compaction
  std::optional<Comparison> comparison;
};

// Throws InputError for folders that hold no pressed panels or are no replicates of each other (one case but for
// run.seed and mat.file, no panel twice), and for measured files that cannot be read.
ProfileAnswer density_profiles(const ProfileQuestion& question);

// Where the program puts the answer unless it is told: runs/<first run>-profile.
std::filesystem::path profile_folder(const ProfileQuestion& question);

// Makes the folder where it is missing and writes tables and pictures; returns a sentence for each picture that could
// not be drawn. Throws as files::write_atomically().
std::vector<std::string> write(const ProfileAnswer& answer, const std::filesystem::path& folder);

// A table of the means for people, and how far the measured profile is from the simulated one.
std::string text_of(const ProfileAnswer& answer);

}  // namespace strandlab::run
