// Stiffnesses made from a known 1/D_t, with errors of measurement, must give it back: without bias worth mentioning,
// and inside the stated 95 % interval 95 times in 100.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "strandlab/bondline/shear_lag.hpp"
#include "strandlab/core/random.hpp"
#include "strandlab/statistics/statistics.hpp"
#include "support/report.hpp"

namespace strandlab::bondline {
namespace {

constexpr int kSamples = 2000;

struct Trial {
  double mean = 0;                 // of 1/D_t recovered, mm/MPa
  double stated = 0, scatter = 0;  // mean standard uncertainty; standard deviation over the samples
  double coverage = 0;             // fraction of 95 % intervals that hold the true value
};

Geometry measured(const Geometry& truth, const Uncertainty& u, RandomStream& random) {
  Geometry g = truth;
  g.E1_MPa *= 1 + u.E_relative * random.normal();
  g.E2_MPa *= 1 + u.E_relative * random.normal();
  g.t1_mm *= 1 + u.t_relative * random.normal();
  g.t2_mm *= 1 + u.t_relative * random.normal();
  g.l_mm += u.l_mm * random.normal();
  return g;
}

Trial run(const Geometry& truth, double compliance, const Uncertainty& u, Formula formula, std::uint64_t stream) {
  RandomStream random(2010, stream);
  const double k = stiffness_N_per_mm(truth, compliance, formula);
  std::vector<double> found;
  Trial trial;
  for (int i = 0; i < kSamples; ++i) {
    const Geometry g = measured(truth, u, random);
    const auto solution = glue_compliance(g, k * (1 + u.k_relative * random.normal()), formula);
    EXPECT_TRUE(solution.value_mm_per_MPa.has_value()) << solution.reason;
    if (!solution.value_mm_per_MPa) continue;
    found.push_back(*solution.value_mm_per_MPa);
    const Propagated p = propagate(g, found.back(), u, formula);
    trial.stated += p.standard_mm_per_MPa / kSamples;
    trial.coverage += (p.low_mm_per_MPa <= compliance && compliance <= p.high_mm_per_MPa ? 1.0 : 0.0) / kSamples;
  }
  const statistics::Summary s = statistics::summarise(found);
  trial.mean = s.mean;
  trial.scatter = s.sd;
  return trial;
}

void expect_recovered(const std::string& specimens, const Geometry& g, double compliance, const Uncertainty& u,
                      Formula formula, std::uint64_t stream) {
  const Trial trial = run(g, compliance, u, formula, stream);
  SCOPED_TRACE(testing::Message() << "1/D_t = " << compliance << " mm/MPa, " << name(formula));
  const std::string what = fmt::format("{}, 1/D_t = {} mm/MPa from {} noisy stiffnesses, {} formula: ", specimens,
                                       compliance, kSamples, name(formula));
  report(what + "95 % intervals that hold it", trial.coverage, between(0.93, 0.97));
  // The error of the mean is .022 of the scatter here; the bend of the curve k(1/D_t) adds about half the squared
  // relative error.
  report(what + "bias over scatter", (trial.mean - compliance) / trial.scatter,
         within(0.1).because("a statistical band: 4 standard errors of the mean"));
  EXPECT_NEAR(trial.stated / trial.scatter, 1, .1);
}

TEST(RoundTrip, NoiseInStiffnessAndSizes) {
  const Geometry g;
  std::uint64_t stream = 0;
  for (double compliance : {.0105, .01628, .03693, .06536, .14645})
    expect_recovered("equal strands", g, compliance, {.01, .01, .01, .25}, Formula::kCoth, stream++);
}

TEST(RoundTrip, UnequalAdherendsTabsAndLargerNoise) {
  const Geometry g{8200, 12500, 610.0, {}, 0.55, 0.83, 5.9, 18, 2, 3};
  std::uint64_t stream = 100;
  for (double compliance : {.0105, .06536})
    expect_recovered("unequal strands, tabs", g, compliance, {.02, .01, .01, .1}, Formula::kCoth, stream++);
}

TEST(RoundTrip, PrintedFormula) {
  expect_recovered("equal strands", {}, .01628, {.01, .01, .01, .25}, Formula::kLe2010, 200);
}

// Slightly negative 1/D_t (fully glued strands): recovered without bias while the noise stays away from the bound.
TEST(RoundTrip, SlightlyNegativeCompliance) {
  const Geometry g;
  const double compliance = -.00022;
  ASSERT_GT(compliance, lower_bound_mm_per_MPa(g));
  expect_recovered("fully glued strands", g, compliance, {.002, .002, .002, .02}, Formula::kCoth, 300);
}

}  // namespace
}  // namespace strandlab::bondline
