// A made-up set of specimens with the means and scatter that were measured on real ones.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace strandlab::bondline {

// One group of Le (2010) Table 2.1: mean of 1/D_t and half its 95 % interval, mm/MPa, and the number of specimens.
struct PublishedGroup {
  const char* name;  // "PF-25", "VTC-PF-1", "PVA-100"
  const char* resin;
  const char* strands;
  int coverage_percent;
  double mean, half_interval;
  int n;
};
const std::vector<PublishedGroup>& published_groups();

// CSV text of specimens of all groups: strands with the scatter of Le's strands (E 9936 +- 935 MPa; VTC 24311 +- 2290
// MPa, the same 9.4 %), t .69 mm, overlap 25 mm, and stiffnesses of glue lines whose 1/D_t has each group's mean and
// standard deviation. The total shear compliance of specimens, which is positive, is log-normal, at evenly spaced
// probabilities in random order, so that mean and deviation are met and not only expected. Where the published
// deviation is more than positive values with the published mean can have (VTC-PF-100), it is cut to kLargestVariation
// times their mean.
std::string example_table(std::uint64_t seed);
inline constexpr double kLargestVariation = 3.5;  // of n = 20 positive values, at most sqrt(n)

}  // namespace strandlab::bondline
