// Frames of a pressing for the report: coarse panels, packed small enough for a web page.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "strandlab/glue/glue.hpp"
#include "strandlab/panel/panel.hpp"

namespace strandlab::report {

inline constexpr int kFrames = 40;  // from the mat as formed to the last compaction; one more with the mat itself

// The panel as a frame keeps it: lumped() to about 8000 cells, three through a strand where that leaves them no longer
// than they must be. Panels of the same mat get the same cells.
Panel<2> frame_of(const Panel<2>& panel);

// Packs frames of one mat, by compaction:
//   {"quantum_mm", "length_mm", "initial_thickness_mm",
//    "strands": [{"kind", "row", "angle_deg", "points": [along, through]}...],
//    "fields": [{"key", "label", "unit", "digits", "diverging", "low", "high"}...]
//                                                       value = low + (high - low) * byte/255, clipped
//    "frames": [{"compaction", "time_ms", "bottom_mm", "top_mm", "cells", "glue"}...]}
// "cells" and "glue" are base64. "cells": corner by corner (strand after strand, along fastest) x then y as numbers of
// quanta; in the first frame the step from the corner before (0 at the start of each strand), in the others the step of
// the displacement since the frame before, from that of the corner before; then for each field a byte per cell. Steps
// are zigzag numbers (2 n for n >= 0, -2 n - 1 below) of seven bits a byte, low bits first, the high bit set where more
// follow. "glue": the lines that would be cured in this state, each as the two strands, the number of points and the
// points' x and y, steps from the point before (0 at the start of a line), all in the same zigzag numbers. Throws
// InputError for frames of different mats.
nlohmann::json pack_frames(const std::vector<Panel<2>>& frames, const glue::CuringOptions& curing);

}  // namespace strandlab::report
