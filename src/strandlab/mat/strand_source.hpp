// Where the strands of a random mat come from: sizes, angle and place of one after the other.
#pragma once

#include <cstddef>

#include "strandlab/core/random.hpp"
#include "strandlab/mat/plate_layup.hpp"

namespace strandlab::mat {

// Angles of all strands that were drawn, whether or not they found a place.
struct DrawnAngles {
  std::size_t count = 0;
  double sum_off_mean_deg = 0;  // of |angle - mean|

  double mean_off_mean_deg() const { return count > 0 ? sum_off_mean_deg / static_cast<double>(count) : 0; }
};

// |difference| of two grain angles, at most 90 degrees.
double off_angle(double angle_deg, double other_deg);

class StrandSource {
 public:
  // Needs angles that check() accepts. Places lie in 0..window.x by 0..window.y.
  StrandSource(const AngleDistribution& angles, const Window& window, RandomStream random);

  PlateStrand draw(const SizeStatistics& sizes);  // length, width (at least kShortestPiece_mm) and angle
  void lay_anywhere(PlateStrand& strand);         // its centre, uniform in the window
  double uniform() { return random_.uniform(); }
  const DrawnAngles& drawn() const { return drawn_; }

 private:
  double mean_deg_;
  AngleSampler angles_;
  Window window_;
  RandomStream random_;
  DrawnAngles drawn_;
};

}  // namespace strandlab::mat
