// Measured density profiles, as X-ray densitometers export them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "strandlab/profile/profile.hpp"

namespace strandlab::profile {

// One specimen: positions through the thickness from the first reading in wood (0) on, increasing.
struct Specimen {
  std::string name;
  std::vector<double> position_mm;
  std::vector<double> density_kg_m3;
  double thickness_mm() const { return position_mm.back(); }
};

// Where the numbers stand, for files whose header does not say it. Columns count from 1; units as in table/units.hpp.
struct MeasuredColumns {
  int position = 0;           // 0: the column named position, depth, distance, height, thickness or x
  std::vector<int> density;   // empty: all columns named density or D
  std::string position_unit;  // empty: as the file states
  std::string density_unit;   // likewise
};

// Reads a table (table/table.hpp says what it may look like): a column of positions and one or more of densities. Each
// density column is a specimen, and so are rows with another text in a column named specimen, sample or board, rows
// from where the positions start again, and rows below a repetition of the header. Rows without both numbers are passed
// over. Throws InputError with the line and the reason for what is no profile: no such column, no unit, text for a
// number, a density that no wood has (below -50, the noise of air, or above 2000 kg/m^3, or nowhere more than 100),
// positions that go back and forth, fewer than five readings of a specimen.
std::vector<Specimen> read_measured(const std::filesystem::path& file, const MeasuredColumns& columns = {});
// The same for a text in memory; `source` opens the messages.
std::vector<Specimen> measured_from_text(const std::string& text, const std::string& source,
                                         const MeasuredColumns& columns = {});

// A specimen's profile: the readings joined by straight lines, and their mean over each bin.
Profile binned(const Specimen& specimen, int bins);

}  // namespace strandlab::profile
