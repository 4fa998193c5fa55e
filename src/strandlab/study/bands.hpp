// Curves of the replicates of a cell as one: their mean with the 95 % interval of the mean.
#pragma once

#include <string>
#include <vector>

#include "strandlab/files/csv.hpp"
#include "strandlab/study/folder.hpp"

namespace strandlab::study {

struct Curve {
  std::vector<double> x, y;  // x increasing
};

struct Band {
  std::vector<double> x, mean, low, high;  // low and high NaN for a single curve
  int n = 0;
};

// On the grid of x; between its points each curve is straight, beyond its ends it keeps their values. Needs a curve.
Band band_of(const std::vector<Curve>& curves, const std::vector<double>& x);

// By cell the pressing stress against compaction, on a hundred steps to the least compaction that all replicates reach:
// columns cell (from 0), n, compaction, stress_MPa, low_MPa, high_MPa. `whole`: the items that count.
files::CsvTable stress_bands(const Study& study, const std::vector<const Item*>& whole);

// By cell and state the density against relative height, on the first replicate's heights: columns cell, state (from
// 1), n, relative_height, density_kg_m3, low_kg_m3, high_kg_m3.
files::CsvTable profile_bands(const Study& study, const std::vector<const Item*>& whole);

}  // namespace strandlab::study
