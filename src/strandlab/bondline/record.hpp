// Stiffness of a specimen from its load-displacement record.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace strandlab::bondline {

struct LoadPoint {
  double load_N = 0, displacement_mm = 0;
};

// Reads a record: columns load (or force) and displacement (or extension, elongation), units in the header or a row of
// units, remarks of the machine above it. Rows without both numbers are skipped. Throws InputError as Table does.
std::vector<LoadPoint> read_record(const std::filesystem::path& file);

// Loads between which the slope is taken.
struct LoadWindow {
  double low = 0.1, high = 0.4;
  bool of_maximum = true;  // fractions of the largest load; else N
};
// Throws InputError unless 0 <= low < high (and high <= 1 for fractions).
void validate(const LoadWindow& window);

struct Slope {
  double stiffness_N_per_mm = 0;
  double standard_error = 0;       // of the stiffness, N/mm; taken from the scatter about the line only
  double r_squared = 0;            // of the points in the window, none left out
  int points = 0;                  // in the window
  double low_N = 0, high_N = 0;    // the window
  double toe_mm = 0;               // displacement lost before the line sets in
  std::vector<std::string> flags;  // toe, slip: plain sentences
  std::string problem;             // why there is no slope; empty when there is one
};

// Robust straight line through the points of the rising branch inside the window: displacement on load (the window is
// set on the load, so its noise does not bias the slope), Huber's M-estimator with tuning constant 1.345 and the scale
// from the median absolute deviation, by iteratively reweighted least squares from Theil's incomplete pairs. Flags a
// specimen whose lower third of the window is more than 5 % softer than the rest (toe), or where load drops or
// displacement jumps (slip).
Slope fit_stiffness(const std::vector<LoadPoint>& record, const LoadWindow& window);

}  // namespace strandlab::bondline
