// Random mats, pressed, and what their density profiles have in common.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "strandlab/mat/form.hpp"
#include "strandlab/press/press.hpp"
#include "strandlab/profile/profile.hpp"

namespace strandlab::profile_tests {

struct Job {
  double length_mm = 16;
  int surface_rows = 2, core_rows = 4;  // surface rows below and above
  int cells_through_strand = 2;
  double cell_aspect = 2;
  double speed_m_s = 16;
  bool symmetric = false;
  std::vector<double> compactions{0.4};
  double surface_yield = 1, surface_stiffness = 1;  // softening factors of surface strands
  double core_yield = 1;
  wood::Law law = wood::Law::kHill;
};

// OSB in the proportions of the main job, with strands and gaps scaled to the short window.
inline mat::Mat osb(const Job& job, std::uint64_t seed) {
  mat::Layup layup;
  layup.length_mm = job.length_mm;
  const mat::LayupRow surface{"surface", {30, 4, 3, 1}}, core{"core", {8, 1, 3.2, 0.4}};
  for (int i = 0; i < 2 * job.surface_rows + job.core_rows; ++i) {
    const bool outside = i < job.surface_rows || i >= job.surface_rows + job.core_rows;
    layup.rows.push_back(outside ? surface : core);
  }
  return mat::form(layup, seed);
}

inline Panel<2> panel_of(const mat::Mat& mat, const Job& job) {
  const double height = mat.layer_thickness_mm / job.cells_through_strand;
  auto poplar = wood::library().front();
  poplar.law = job.law;
  return make_panel(
      mat, {{"surface", poplar, 0, job.surface_yield, job.surface_stiffness}, {"core", poplar, 90, job.core_yield}},
      height * job.cell_aspect / 2, 2 * job.cells_through_strand);
}

// The pressing of the job, which hands the panel at each compaction to `sink`.
inline press::Outcome<2> press_job(const Panel<2>& mat, const Job& job, const press::Sink<2>& sink) {
  press::Resolution resolution;
  resolution.cells_through_strand = job.cells_through_strand;
  resolution.cell_aspect = job.cell_aspect;
  press::Schedule schedule;
  schedule.speed_m_s = job.speed_m_s;
  schedule.symmetric = job.symmetric;
  schedule.compactions = job.compactions;
  return press::press<2>(mat, schedule, press::setup(mat, resolution, mpm::Side::kRoller, mpm::Options{}), sink);
}

// The panel at each compaction of the job.
inline std::vector<Panel<2>> pressed(const Panel<2>& mat, const Job& job) {
  std::vector<Panel<2>> states;
  press::Sink<2> sink;
  sink.snapshot = [&states](const Panel<2>& panel, int) { states.push_back(panel); };
  press_job(mat, job, sink);
  return states;
}

inline int cells_through(const Panel<2>& panel, const Job& job) {
  const double cell = 0.8 / job.cells_through_strand;
  return static_cast<int>(std::lround(panel.initial_thickness_mm / cell));  // they follow the platens
}

// Mean and band of replicates with the seeds 1..n.
inline profile::Mean replicates(const Job& job, int n) {
  std::vector<profile::Profile> profiles;
  for (int seed = 1; seed <= n; ++seed) {
    const auto panel = pressed(panel_of(osb(job, static_cast<std::uint64_t>(seed)), job), job).back();
    profiles.push_back(profile::density_profile(panel, cells_through(panel, job)));
  }
  return profile::mean(profiles);
}

// Half the width of the replicates' 95 % band, root mean square over the thickness.
inline double half_band(const profile::Mean& mean) {
  double sum = 0;
  for (const auto& bin : mean.density_kg_m3) sum += std::pow(0.5 * (bin.high - bin.low), 2);
  return std::sqrt(sum / static_cast<double>(mean.density_kg_m3.size()));
}

}  // namespace strandlab::profile_tests
