// The resolution of mat files.
#pragma once

#include <cmath>

namespace strandlab::mat {

inline constexpr double kResolution = 1e6;  // coordinates and angles are whole multiples of its inverse, mm or degree

// Nearest double to a coordinate rounded to 1e-6 mm: the number that the file's text reads back as.
inline double on_raster(double mm) {
  return std::round(mm * kResolution) / kResolution;
}

}  // namespace strandlab::mat
