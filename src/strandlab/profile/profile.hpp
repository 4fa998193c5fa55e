// Density of a panel through its thickness (vertical density profile).
#pragma once

#include <optional>
#include <vector>

#include "strandlab/panel/panel.hpp"
#include "strandlab/statistics/statistics.hpp"

namespace strandlab::profile {

// Mass in horizontal layers of equal height from the bottom face to the top one, over the layers' volume.
struct Profile {
  double compaction = 0;
  double thickness_mm = 0;
  std::vector<double> density_kg_m3;  // by bin, bottom to top
  int bins() const { return static_cast<int>(density_kg_m3.size()); }
  double bin_height_mm() const { return thickness_mm / bins(); }
};

// Profile of a panel as it lies between the platens. The domain of every material point, the parallelogram (in 3D the
// parallelepiped) x +- F spacing/2, is cut exactly by the bins' edges; what sticks out of a face counts in the bin
// there, so that the integral over the thickness is mass over area, wherever the points are. Volume is that of the
// window 0..length. Throws InputError for a panel without thickness or bins < 1.
template <int Dim>
Profile density_profile(const Panel<Dim>& panel, int bins);

// The same in each of `columns` equal parts of the window along the panel, left to right. Each part of a domain is
// spread over the heights of the whole of it; what sticks out of an end counts in the column there. Throws InputError
// for columns < 1, and as density_profile() does.
template <int Dim>
std::vector<Profile> density_profiles(const Panel<Dim>& panel, int bins, int columns);

// Mean of a profile over the relative heights from..to (0 bottom face, 1 top face), kg/m^3.
double mean_between(const Profile& profile, double from, double to);

inline constexpr double kSkin = 0.05;     // of the thickness, below either face
inline constexpr double kSurface = 0.25;  // of the thickness, below either face; the core is what lies between

// What a profile comes down to, kg/m^3 and mm. In each half of the thickness the densest bin is a peak, its depth the
// distance of the bin's middle from the face.
struct Summary {
  double mean = 0;
  double peak = 0, peak_depth_mm = 0;  // mean of those below both faces
  double peak_bottom = 0, peak_bottom_depth_mm = 0, peak_top = 0, peak_top_depth_mm = 0;
  double skin = 0;     // outermost twentieth of the thickness below either face
  double surface = 0;  // outer quarter below either face
  double core = 0;     // middle half
  double surface_over_core() const { return core > 0 ? surface / core : 0; }
};
Summary summarise(const Profile& profile);

// Replicates at one compaction: by bin the mean, its sd between replicates and the 95 % t-interval of the mean (NaN for
// one replicate). Bins count from the bottom face by relative height.
struct Mean {
  double compaction = 0, thickness_mm = 0;  // means
  std::vector<strandlab::statistics::Summary> density_kg_m3;
  Profile profile() const;  // of the means
};
// Throws InputError unless there is a profile and all have the same number of bins.
Mean mean(const std::vector<Profile>& replicates);

// The same profile in another number of bins: the mean of the old ones over each new one.
Profile rebinned(const Profile& profile, int bins);

// Root mean square over the thickness of the difference between two profiles, kg/m^3; the finer one is rebinned.
double rms_difference(const Profile& a, const Profile& b);

}  // namespace strandlab::profile
