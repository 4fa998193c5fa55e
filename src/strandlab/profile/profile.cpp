#include "strandlab/profile/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/profile/domain.hpp"

namespace strandlab::profile {
namespace {

// Adds a mass spread over lengths along an axis around `centre` (in bins, from the first one's edge).
template <int Dim>
void add(const std::array<double, Dim>& spans, double centre, double mass, std::vector<double>& bins) {
  const int count = static_cast<int>(bins.size());
  double reach = 0;
  for (const double h : spans) reach += 0.5 * h;
  const int first = std::clamp(static_cast<int>(std::floor(centre - reach)), 0, count - 1);
  const int last = std::clamp(static_cast<int>(std::floor(centre + reach)), 0, count - 1);
  double below = 0;
  for (int k = first; k <= last; ++k) {
    const double upto = k == last ? 1 : part_below<Dim>(spans, k + 1 - centre);
    bins[static_cast<std::size_t>(k)] += mass * (upto - below);
    below = upto;
  }
}

struct Peak {
  double density = 0, depth_mm = 0;
};

// The densest bin within half the thickness of the bottom face; the outer one of equals.
Peak peak_from_bottom(const Profile& profile) {
  Peak peak;
  for (int k = 0; 2 * k < profile.bins(); ++k) {
    const double density = profile.density_kg_m3[static_cast<std::size_t>(k)];
    if (density > peak.density) peak = {density, (k + 0.5) * profile.bin_height_mm()};
  }
  return peak;
}

}  // namespace

template <int Dim>
std::vector<Profile> density_profiles(const Panel<Dim>& panel, int bins, int columns) {
  if (bins < 1) throw InputError(fmt::format("a density profile of {} bins: at least 1 is needed", bins));
  if (columns < 1) throw InputError(fmt::format("density profiles of {} columns: at least 1 is needed", columns));
  Profile profile;
  profile.compaction = panel.compaction();
  profile.thickness_mm = panel.thickness_mm();
  const double area = panel.length_mm * (Dim == 2 ? 1 : panel.depth_mm);  // a section is counted per mm of depth
  if (!(profile.thickness_mm > 0 && area > 0)) throw InputError("a density profile needs a panel with a thickness");
  profile.density_kg_m3.assign(static_cast<std::size_t>(bins), 0.0);
  std::vector<Profile> profiles(static_cast<std::size_t>(columns), profile);
  const double height = profile.bin_height_mm(), width = panel.length_mm / columns;
  std::vector<double> parts(profiles.size());  // of a domain, by column
  for (const auto& strand : panel.strands) {
    const double mass = strand.material.density / kTonnePerMm3 * strand.lattice.point_volume();  // kg/m^3 mm^3
    for (std::size_t p = 0; p < strand.size(); ++p) {
      const auto& F = strand.points.F[p];
      const auto& x = strand.points.x[p];
      const auto spans_of_bins = heights<Dim>(F, strand.lattice.spacing / height);
      std::fill(parts.begin(), parts.end(), 0.0);
      add<Dim>(spans<Dim>(F, strand.lattice.spacing / width, 0), x[0] / width, 1, parts);
      for (std::size_t c = 0; c < parts.size(); ++c) {
        if (parts[c] == 0) continue;
        add<Dim>(spans_of_bins, (x[Dim - 1] - panel.bottom_mm) / height, parts[c] * mass / (area / columns * height),
                 profiles[c].density_kg_m3);
      }
    }
  }
  return profiles;
}

template <int Dim>
Profile density_profile(const Panel<Dim>& panel, int bins) {
  return density_profiles(panel, bins, 1).front();
}

double mean_between(const Profile& profile, double from, double to) {
  const double bins = profile.bins();
  double sum = 0;
  for (int k = 0; k < profile.bins(); ++k) {
    const double share = std::min((k + 1) / bins, to) - std::max(k / bins, from);
    if (share > 0) sum += share * profile.density_kg_m3[static_cast<std::size_t>(k)];
  }
  return sum / (to - from);
}

Summary summarise(const Profile& profile) {
  Summary s;
  s.mean = mean_between(profile, 0, 1);
  s.skin = 0.5 * (mean_between(profile, 0, kSkin) + mean_between(profile, 1 - kSkin, 1));
  s.surface = 0.5 * (mean_between(profile, 0, kSurface) + mean_between(profile, 1 - kSurface, 1));
  s.core = mean_between(profile, kSurface, 1 - kSurface);
  auto turned = profile;
  std::reverse(turned.density_kg_m3.begin(), turned.density_kg_m3.end());
  const Peak bottom = peak_from_bottom(profile), top = peak_from_bottom(turned);
  s.peak_bottom = bottom.density;
  s.peak_bottom_depth_mm = bottom.depth_mm;
  s.peak_top = top.density;
  s.peak_top_depth_mm = top.depth_mm;
  s.peak = 0.5 * (bottom.density + top.density);
  s.peak_depth_mm = 0.5 * (bottom.depth_mm + top.depth_mm);
  return s;
}

Profile Mean::profile() const {
  Profile p{compaction, thickness_mm, {}};
  for (const auto& bin : density_kg_m3) p.density_kg_m3.push_back(bin.mean);
  return p;
}

Mean mean(const std::vector<Profile>& replicates) {
  if (replicates.empty()) throw InputError("a mean profile needs at least one replicate");
  const Profile& first = replicates.front();
  Mean result{first.compaction, first.thickness_mm, {}};  // plus mean differences: equal numbers stay as they are
  for (const auto& profile : replicates) {
    if (profile.bins() != first.bins()) {
      throw InputError(fmt::format("density profiles of {} and {} bins: replicates need the same number of bins",
                                   first.bins(), profile.bins()));
    }
    result.compaction += (profile.compaction - first.compaction) / static_cast<double>(replicates.size());
    result.thickness_mm += (profile.thickness_mm - first.thickness_mm) / static_cast<double>(replicates.size());
  }
  for (std::size_t k = 0; k < first.density_kg_m3.size(); ++k) {
    std::vector<double> values;
    values.reserve(replicates.size());
    for (const auto& profile : replicates) values.push_back(profile.density_kg_m3[k]);
    result.density_kg_m3.push_back(statistics::summarise(values));
  }
  return result;
}

Profile rebinned(const Profile& profile, int bins) {
  Profile result{profile.compaction, profile.thickness_mm, {}};
  for (int k = 0; k < bins; ++k)
    result.density_kg_m3.push_back(mean_between(profile, static_cast<double>(k) / bins, (k + 1.0) / bins));
  return result;
}

double rms_difference(const Profile& a, const Profile& b) {
  const int bins = std::min(a.bins(), b.bins());
  const Profile one = rebinned(a, bins), other = rebinned(b, bins);
  double sum = 0;
  for (std::size_t k = 0; k < one.density_kg_m3.size(); ++k)
    sum += std::pow(one.density_kg_m3[k] - other.density_kg_m3[k], 2);
  return std::sqrt(sum / bins);
}

template Profile density_profile<2>(const Panel<2>&, int);
template Profile density_profile<3>(const Panel<3>&, int);
template std::vector<Profile> density_profiles<2>(const Panel<2>&, int, int);
template std::vector<Profile> density_profiles<3>(const Panel<3>&, int, int);

}  // namespace strandlab::profile
