// Density profiles of pressed mats: what must hold whatever the mat, and what the platens and the wood do to them.
#include <gtest/gtest.h>

#include "support/report.hpp"
#include "verification/profile/mats.hpp"

namespace strandlab::profile_tests {
namespace {

// Every row of the mat is the same strand from side to side: an even column, uniform strain, a flat profile.
TEST(PressedProfile, OfAUniformStackIsFlat) {
  Job job;
  job.length_mm = 4;
  job.speed_m_s = 4;
  mat::Layup layup{job.length_mm, 0.8, {4, {"surface", {0, 0, 0, 0}}}};
  const auto panel = pressed(panel_of(mat::form(layup, 1), job), job).back();
  const auto p = profile::density_profile(panel, cells_through(panel, job));
  const double mean = profile::mean_between(p, 0, 1);
  double worst = 0;
  for (const double density : p.density_kg_m3) worst = std::max(worst, std::abs(density / mean - 1));
  report("uniform stack at 40 %: largest deviation of a bin from the mean", 100 * worst, "< 1", "%");
  EXPECT_LT(worst, 0.01);
  EXPECT_NEAR(mean * (1 - p.compaction) / 350, 1, 1e-12);  // 350 kg/m^3, compacted
}

TEST(PressedProfile, IntegralIsMassOverArea) {
  Job job;
  job.compactions = {0, 0.2, 0.4};
  const auto mat = panel_of(osb(job, 1), job);
  double mass = 0;  // from the mat's strands, kg/m^3 mm^2
  for (const auto& s : mat.strands) mass += 350 * static_cast<double>(s.size()) * s.lattice.point_volume();
  double worst = 0;
  for (const auto& panel : pressed(mat, job)) {
    for (const int bins : {16, 25}) {
      const auto p = profile::density_profile(panel, bins);
      const double sum = std::accumulate(p.density_kg_m3.begin(), p.density_kg_m3.end(), 0.0);
      worst = std::max(worst, std::abs(p.bin_height_mm() * sum / (mass / mat.length_mm) - 1));
    }
  }
  report("integral of the profile over mass/area, minus 1", worst, "< 1e-12");
  EXPECT_LT(worst, 1e-12);
}

// Rows turned upside down, both platens moving alike: the mirrored run, up to round-off that contact amplifies.
TEST(PressedProfile, OfAMirroredMatIsMirrored) {
  Job job;
  job.symmetric = true;
  job.compactions = {0, 0.1, 0.2};
  auto mat = osb(job, 3);
  const auto upright = pressed(panel_of(mat, job), job);
  std::reverse(mat.layers.begin(), mat.layers.end());
  const auto turned = pressed(panel_of(mat, job), job);
  for (std::size_t i = 0; i < upright.size(); ++i) {
    const int bins = cells_through(upright[i], job);
    const auto p = profile::density_profile(upright[i], bins);
    auto q = profile::density_profile(turned[i], bins);
    std::reverse(q.density_kg_m3.begin(), q.density_kg_m3.end());
    const double difference = profile::rms_difference(p, q) / profile::mean_between(p, 0, 1);
    report(
        "mirrored mat, rms difference over the mean at compaction " + std::to_string(job.compactions[i]).substr(0, 3),
        difference, "< 1e-9");
    EXPECT_LT(difference, 1e-9) << "compaction " << job.compactions[i];
  }
}

// Softer surface strands are pressed further, at the cost of the core: with half the stiffness alone, and with half the
// yield stresses too.
TEST(PressedProfile, SofterSurfaceStrandsAreDenser) {
  Job job;
  const auto control = profile::summarise(replicates(job, 2).profile());
  for (const double yield : {1.0, 0.5}) {
    job.surface_stiffness = 0.5;
    job.surface_yield = yield;
    const auto soft = profile::summarise(replicates(job, 2).profile());
    const auto what = yield < 1 ? "halved surface stiffness and yield" : "halved surface stiffness";
    report(std::string(what) + ": surface density over control, 40 %", soft.surface / control.surface, "> 1.02");
    report(std::string(what) + ": core density over control", soft.core / control.core, "< 0.99");
    EXPECT_GT(soft.surface, 1.02 * control.surface) << what;
    EXPECT_LT(soft.core, 0.99 * control.core) << what;
    EXPECT_NEAR(soft.mean / control.mean, 1, 1e-3) << what;
  }
}

}  // namespace
}  // namespace strandlab::profile_tests
