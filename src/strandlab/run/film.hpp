// The pressing of a run folder as a film.
#pragma once

#include <cstddef>
#include <filesystem>

#include "strandlab/report/section_picture.hpp"

namespace strandlab::run {

struct FilmOptions {
  report::Colouring colouring = report::Colouring::kGrainAngle;
  double frames_per_s = 10;  // 0.5..60
  int width_px = 1600;
};

// Replaces `out`, an .mp4 or a .gif file, by a film of the folder's frames, encoded by ffmpeg; returns the number of
// frames. Throws InputError for options it cannot use, where ffmpeg is not installed, and for a folder without a
// pressed panel; RunError when ffmpeg fails.
std::size_t make_film(const std::filesystem::path& run_folder, const std::filesystem::path& out,
                      const FilmOptions& options);

}  // namespace strandlab::run
