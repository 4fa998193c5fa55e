// Up to 16 m/s the platens' speed does not show in the density profile; from 64 m/s on inertia does. The measure is the
// replicates' own band, the half width of the 95 % t-interval of their mean, root mean square over the thickness.
// Compared early in the pressing, where inertia is largest against what the wood withstands: later the wood is pressed
// flat at any speed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/report.hpp"
#include "verification/profile/mats.hpp"

namespace strandlab::profile_tests {
namespace {

void expect_within_band(const std::string& mats, Job job, int n, double reference_speed,
                        const std::vector<double>& slow, const std::vector<double>& fast) {
  job.speed_m_s = reference_speed;
  const auto reference = replicates(job, n);
  const double band = half_band(reference);
  const auto over_band = [&](double speed) {
    job.speed_m_s = speed;
    return profile::rms_difference(reference.profile(), replicates(job, n).profile()) / band;
  };
  const auto what = [&](double speed) {
    return fmt::format("{} mats, {} against {} m/s, {:g} % compaction: rms difference over the band", mats, speed,
                       reference_speed, 100 * job.compactions.back());
  };
  for (const double speed : slow) {
    const double ratio = over_band(speed);
    report(what(speed), ratio, below(0.5));
  }
  for (const double speed : fast) {
    const double ratio = over_band(speed);
    report(what(speed), ratio, above(1));
  }
}

// Short, thin mats: their band is wide, and it takes more speed to leave it.
TEST(PlatenSpeed, OfShortMatsShowsOnlyWhenFast) {
  Job job;
  job.length_mm = 40;
  job.surface_rows = 3;
  job.core_rows = 6;
  job.compactions = {0.05};
  expect_within_band("short", job, 4, 16, {8}, {256});
}

// Mats of the main job's size.
TEST(PlatenSpeed, OfFullMatsShowsFrom64MetresASecondNightly) {
  Job job;
  job.length_mm = 100;
  job.surface_rows = 5;
  job.core_rows = 10;
  job.compactions = {0.05};
  expect_within_band("full", job, 5, 16, {4, 8}, {64, 128});
}

}  // namespace
}  // namespace strandlab::profile_tests
