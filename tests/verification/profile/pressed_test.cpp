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
  report("uniform stack at 40 %: largest deviation of a bin from the mean", 100 * worst, below(5e-3), "%");
  EXPECT_NEAR(mean * (1 - p.compaction) / 350, 1, 1e-12);  // 350 kg/m^3, compacted
}

// Mass below every bin's edge, against the mass counted anew: each point's domain x + F spacing (r, s), |r|, |s| <=
// 1/2, as 32 x 32 grains. (The sum over all bins says little: what a point leaves over goes to its last bin.)
double mass_below(const Panel<2>& panel, double height_mm) {
  constexpr int kGrains = 32;
  double mass = 0;  // kg/m^3 mm^2
  for (const auto& s : panel.strands) {
    for (std::size_t p = 0; p < s.size(); ++p) {
      int below = 0;
      for (int i = 0; i < kGrains; ++i) {
        for (int j = 0; j < kGrains; ++j) {
          const Vec<2> at((i + 0.5) / kGrains - 0.5, (j + 0.5) / kGrains - 0.5);
          below +=
              (s.points.x[p] + s.points.F[p] * at.cwiseProduct(s.lattice.spacing))[1] - panel.bottom_mm < height_mm;
        }
      }
      mass += 350 * s.lattice.point_volume() * below / (kGrains * kGrains);
    }
  }
  return mass;
}

TEST(PressedProfile, HasTheMassThatLiesBelowEveryHeight) {
  Job job;
  job.compactions = {0, 0.2, 0.4};
  const auto mat = panel_of(osb(job, 1), job);
  double mass = 0;  // from the mat's strands, kg/m^3 mm^2
  for (const auto& s : mat.strands) mass += 350 * static_cast<double>(s.size()) * s.lattice.point_volume();
  double worst = 0;
  for (const auto& panel : pressed(mat, job)) {
    for (const int bins : {16, 25}) {
      const auto p = profile::density_profile(panel, bins);
      double so_far = 0;
      for (int k = 0; k + 1 < bins; ++k) {
        so_far += p.density_kg_m3[static_cast<std::size_t>(k)] * p.bin_height_mm() * panel.length_mm;
        worst = std::max(worst, std::abs(so_far - mass_below(panel, (k + 1) * p.bin_height_mm())) / mass);
      }
    }
  }
  report("mass below every height of the profile, largest difference from grains counted, over all mass", worst,
         below(1e-3));
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
        difference, below(1e-10).because(test::kRoundOff));
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
    report(std::string(what) + ": surface density over control, 40 %", soft.surface / control.surface, above(1.02));
    report(std::string(what) + ": core density over control", soft.core / control.core, below(0.99));
    EXPECT_NEAR(soft.mean / control.mean, 1, 1e-3) << what;
  }
}

}  // namespace
}  // namespace strandlab::profile_tests
