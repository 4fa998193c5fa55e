// Random forming of section mats: each row a stationary sequence strand, gap, strand, gap...
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/mat/angles.hpp"
#include "strandlab/mat/mat.hpp"

namespace strandlab::mat {

// Lengths and thicknesses of a layup lie within these: far below any strand, far above the resolution; and places stay
// exact in whole 1e-6 mm.
inline constexpr double kSmallestSize_mm = 1e-3, kLargestSize_mm = 1e9;

// Statistics of one kind of strand. Lengths, widths and gaps are normal, truncated to positive values. Without a width
// lengths are those that the section shows, whatever the angle; with one they are those of whole strands, of which the
// section shows what their angle lets it (cut.hpp).
// gap_mm = 0 with gap_sd_mm = 0 and length_mm = 0: one strand fills the row (plywood, LVL).
struct StrandStatistics {
  double length_mm = 150, length_sd_mm = 20;
  double gap_mm = 15, gap_sd_mm = 4.95;  // between strands, in the section
  double width_mm = 0, width_sd_mm = 0;
};

struct LayupRow {
  std::string kind;  // strand kind, becomes the layer's role
  StrandStatistics statistics;
  std::optional<double> thickness_mm = {};  // else the layup's layer_thickness_mm
  std::optional<AngleDistribution> angles =
      {};  // else all strands have the angle of their kind, along the section if they have a width; the mat names none
};

struct Layup {
  double length_mm = 100;
  double layer_thickness_mm = 0.8;
  std::vector<LayupRow> rows;  // bottom to top
};

// The mat of a layup: rows are independent and stationary (row.hpp), cut to the window. Throws InputError (row, what is
// wrong) when a truncated distribution degenerates (sd > mean), a size is not positive, or a window shorter than a gap
// leaves a row without strands. The same seed gives the same mat, to the last bit of its file, on every machine:
// counter-based random stream keyed by (seed, row), places drawn on the 1e-6 mm raster of the file. Angles have streams
// of their own, and the places of strands do not depend on them, but where they decide what the section shows.
Mat form(const Layup& layup, std::uint64_t seed);

}  // namespace strandlab::mat
