// Up to 16 m/s the platens' speed does not show in the density profile; from 64 m/s on inertia does. The measure is the
// replicates' own band, the half width of the 95 % t-interval of their mean, root mean square over the thickness.
// Compared early in the pressing, where inertia is largest against what the wood withstands: later the wood is pressed
// flat at any speed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

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

// Pressing stress of a job (MPa) over a fiftieth of compaction from `from` on, and its last density profile.
struct Pressed {
  std::vector<press::Record> records;
  profile::Profile profile;
  double stress(double from) const {
    double sum = 0, count = 0;
    for (const auto& r : records) {
      if (r.compaction < from || r.compaction >= from + 0.02) continue;
      sum += r.stress_MPa;
      ++count;
    }
    return sum / count;
  }
};

Pressed pressed_at(double speed_m_s, Job job, std::uint64_t seed) {
  job.speed_m_s = speed_m_s;
  Pressed result;
  press::Sink<2> sink;
  sink.snapshot = [&](const Panel<2>& panel, int) {
    result.profile = profile::density_profile(panel, cells_through(panel, job));
  };
  result.records = press_job(panel_of(osb(job, seed), job), job, sink).records;
  return result;
}

// Mats that crush are soft and carry slow plastic waves, but 16 m/s is slow for them too: the same stress as at 2 m/s
// once gaps have closed, and the same density profile. bench/press_speed has the mats of the OSB case, down to 1 m/s.
TEST(PlatenSpeed, OfMatsThatCrushDoesNotShowAt16MetresASecond) {
  Job job;
  job.law = wood::Law::kCrushing;
  job.surface_yield = 0.5;
  job.core_yield = 0.75;
  job.compactions = {0.5};
  double stress = 0, shape = 0;
  for (const std::uint64_t seed : {1, 2}) {
    const auto fast = pressed_at(16, job, seed), slow = pressed_at(2, job, seed);
    for (const double from : {0.2, 0.3, 0.4, 0.47}) {
      const double change = fast.stress(from) / slow.stress(from) - 1;
      if (std::abs(change) > std::abs(stress)) stress = change;
    }
    shape = std::max(shape,
                     profile::rms_difference(fast.profile, slow.profile) / profile::mean_between(slow.profile, 0, 1));
  }
  report("mats that crush, 16 against 2 m/s, from 20 % compaction on: largest change of the pressing stress", stress,
         within(0.05));
  report("mats that crush, 16 against 2 m/s, at 50 % compaction: rms change of the density profile over the mean",
         shape, below(0.02));
}

}  // namespace
}  // namespace strandlab::profile_tests
