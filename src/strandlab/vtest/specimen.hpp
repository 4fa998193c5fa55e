// The specimen of a virtual test: what lies between its end planes.
#pragma once

#include <vector>

#include "strandlab/panel/panel.hpp"

namespace strandlab::vtest {

// A panel cut at x = 0 and x = length.
struct Specimen {
  Panel<2> panel;
  std::vector<int> strand;  // by strand of the specimen: which strand of the panel it was
  double furthest_mm = 0;   // how far strands reached beyond the planes
  double cut_fraction = 0;  // of the wood, by volume as formed
  int strands_outside = 0;  // wholly beyond a plane, or but for a sliver
};

// Strands that free sides let out of the window 0..length are cut at its end planes: a strand's lattice of material
// points is resampled between the places where its mean line crosses the planes, with the points' deformation
// gradients. Strands that reach less than kCreep of their point spacing beyond, as between rollers, stay as they
// are, and so do strand ends drawn inward: what does not reach a plane is not loaded there.
Specimen cut_to_window(const Panel<2>& panel);

// A strand cut by the window may have crept a little in pressing: within this of its point spacing it is at the plane.
inline constexpr double kCreep = 0.25;

}  // namespace strandlab::vtest
