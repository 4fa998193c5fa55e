// The figures of a run, set for paper.
#pragma once

#include <filesystem>

#include "strandlab/report/gnuplot.hpp"
#include "strandlab/report/paper.hpp"

namespace strandlab::run {

// Draws into the folder `out`, as far as the run has got: section_grain_angle_C and section_density_C of each
// compaction C that was kept, stress, density_profile, grain_angles, thickness_strains, and each test's modulus against
// glue and against compaction, with models. Throws InputError for a folder without a pressed panel, a width beyond 30
// to 500 mm, letters beyond 4 to 40 points and a font whose name is not letters, digits, spaces, - and .; otherwise as
// files::write_atomically().
report::Drawn draw_figures(const std::filesystem::path& run_folder, const std::filesystem::path& out,
                           const report::Paper& paper);

}  // namespace strandlab::run
