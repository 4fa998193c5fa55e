// Density profiles as tables and plots.
#pragma once

#include <string>
#include <vector>

#include "strandlab/files/csv.hpp"
#include "strandlab/profile/measured.hpp"
#include "strandlab/profile/profile.hpp"
#include "strandlab/report/gnuplot.hpp"

namespace strandlab::report {

// profile.csv of a run, one row per compaction and bin: compaction, from_mm, to_mm (heights over the bottom face),
// relative_height (of the bin's middle, 0 bottom face, 1 top face), density_kg_m3.
files::CsvTable profile_table(const std::vector<profile::Profile>& states);

// profile_summary.csv, one row per compaction: what profile::Summary holds.
files::CsvTable profile_summary_table(const std::vector<profile::Profile>& states);

// Density against relative height, one curve per compaction.
Plot profile_plot(const std::vector<profile::Profile>& states);

// ---- Several runs --------------------------------------------------------------------------------------------------

// A run and its profiles by compaction.
struct Replicate {
  std::string name;
  std::vector<profile::Profile> states;
};

// One row per replicate, compaction and bin: replicate, then the columns of profile_table().
files::CsvTable replicate_profile_table(const std::vector<Replicate>& replicates);
// One row per replicate and compaction, then the mean of the replicates and the ends of its 95 % t-interval (replicate
// "mean", "low", "high"; the last two only for two or more).
files::CsvTable replicate_summary_table(const std::vector<Replicate>& replicates);
// One row per compaction and bin: compaction, relative_height, density_kg_m3 (mean), sd, low, high (95 % t-interval of
// the mean), replicates.
files::CsvTable mean_profile_table(const std::vector<profile::Mean>& means);

// Mean profiles with their 95 % t-interval as a band, one per compaction.
Plot mean_profile_plot(const std::vector<profile::Mean>& means);
// Peak, skin, surface, core and mean density of the replicates' mean profile against compaction.
Plot profile_summary_plot(const std::vector<profile::Mean>& means);

// ---- Measured profiles ---------------------------------------------------------------------------------------------

// One row per specimen and reading: specimen, position_mm (from the first reading), relative_height, density_kg_m3.
files::CsvTable measured_table(const std::vector<profile::Specimen>& specimens);
// One row per compaction: simulated mean density, measured mean density, rms_difference_kg_m3 of the mean profiles, and
// rms_difference_of_shapes, that of the profiles each over its own mean (no unit).
files::CsvTable comparison_table(const std::vector<profile::Mean>& simulated, const profile::Mean& measured);
// One compaction's simulated mean with its band, the measured specimens' mean over it, and the rms difference.
Plot measured_profile_plot(const profile::Mean& simulated, const profile::Mean& measured);

}  // namespace strandlab::report
