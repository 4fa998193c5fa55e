// In-plane angles of the strands of a kind.
#pragma once

#include <string>
#include <vector>

#include "strandlab/core/random.hpp"

namespace strandlab::mat {

inline constexpr double kMostConcentrated = 300;  // largest kappa: a standard deviation of 1.7 degrees

// Each strand draws its own angle, the mean and a deviation; at most one of the three measures is not zero. Grain has
// no sense of direction: deviations lie within 90 degrees.
struct AngleDistribution {
  double mean_deg = 0;
  double spread_deg = 0;  // uniform within +- this, at most 90 (any angle)
  double sd_deg = 0;      // normal with this standard deviation, at most 90, deviations taken modulo 180 degrees
  double kappa = 0;       // von Mises in the doubled angle, density proportional to exp(kappa cos(2 deviation))
};

// Throws InputError ("where: what is wrong") for values beyond those above.
void check(const AngleDistribution& angles, const std::string& where);

// Draws angles by inversion, on a raster of .001 degree: the same on every machine.
class AngleSampler {
 public:
  explicit AngleSampler(const AngleDistribution& angles);  // needs what check() accepts
  double draw(RandomStream& random) const;                 // degrees

 private:
  double deviation(RandomStream& random) const;
  double von_mises(double u) const;

  AngleDistribution angles_;
  std::vector<double> share_;  // of von Mises: the part of angles below each of evenly spaced deviations from -90 to 90
};

}  // namespace strandlab::mat
