// Resin that covers a part of the strands' faces, evenly or in spots, and what a bond lacks for it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace strandlab::glue {

struct Coverage {
  double mean = 1;     // part of the faces that resin covers, 0 < mean <= 1
  double spot_mm = 0;  // length of a spot along the strand as formed; 0: so fine that every stretch has the mean
  // Measured classes: part covered, increasing up to 1, and 1/D_t there (mm/MPa, not increasing). Phenol-formaldehyde
  // on poplar, Le (2010), Table 2.1, where it is -.00022 at full coverage: a perfect bond (bond.hpp).
  std::vector<double> classes{.01, .25, 1}, compliances{.01628, .01048, 0};
  std::uint64_t seed = 1;  // of the spots
};

// Throws InputError for a mean or classes that are not as said, or a negative size of spots.
void check(const Coverage& coverage);

// 1/D_t (mm/MPa) that a line has where this part is covered, over that of one covered whole: linear between the
// classes; below the first of them stiffness is in proportion to what is covered, infinite where nothing is.
double lacking(const Coverage& coverage, double covered);

// Spots on one face of a strand: a Boolean model. Their middles are a Poisson process of -ln(1 - mean)/spot_mm per mm,
// so that each place is covered with the probability `mean`, by one spot or several.
class Spots {
 public:
  // On a face `length_mm` long as formed; its own spots for every seed and number of the face.
  Spots(const Coverage& coverage, double length_mm, std::uint64_t face);
  // The part covered of a stretch of the face, from < to.
  double covered(double from_mm, double to_mm) const;

 private:
  std::vector<std::array<double, 2>> spots_;  // mm, from and to, apart from each other, increasing
};

}  // namespace strandlab::glue
