// Spots of resin: a fine pattern of them is a glue line of the mean.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/report.hpp"
#include "verification/vtest/reference_panels.hpp"

namespace strandlab::vtest {
namespace {

using test::below;

constexpr double kLap = 30;         // mm
constexpr double kCompliance = .2;  // mm/MPa, covered whole: shear decays along the lap over sqrt(E h/(2 D)) = 28 mm

// Two strands that overlap by the lap.
Panel<2> lap_joint() {
  mat::Mat mat;
  mat.length_mm = 2 * kLap;
  mat.layer_thickness_mm = .8;
  for (const double from : {0., .5 * kLap}) {
    mat::Strand strand;
    strand.x0_mm = from;
    strand.x1_mm = from + 1.5 * kLap;
    mat.layers.emplace_back().role = "surface";
    mat.layers.back().strands.push_back(strand);
  }
  return panel_of(mat, .2);
}

Options tension(double compliance, const glue::Coverage& coverage) {
  Options options;
  options.kinds = {TestKind::kTension};
  options.compliance_t_mm_per_MPa = {compliance};
  options.curing.point_spacing_mm = .05;
  options.curing.coverage = coverage;
  return options;
}

double modulus(const Panel<2>& panel, const Options& options) {
  return measure(panel, options).moduli.front().modulus_MPa;
}

// Where every glue point sees many spots its coverage is the mean: the joint is that of resin spread evenly.
TEST(ResinSpots, MuchSmallerThanGluePointsAreEvenlySpread) {
  const auto panel = lap_joint();
  glue::Coverage coverage;
  coverage.mean = .25;
  const double even = modulus(panel, tension(kCompliance, coverage));
  double before = 0;
  for (const double spot : {1e-3, 1e-5}) {
    coverage.spot_mm = spot;
    const double change = std::abs(modulus(panel, tension(kCompliance, coverage)) / even - 1);
    report(fmt::format("modulus of a lap with spots of {} mm on a quarter, against resin spread evenly", spot), change,
           below(spot > 1e-4 ? 2e-3 : 1e-4));
    if (before > 0) {
      EXPECT_LT(change, before);
    }
    before = change;
  }
}

// Where the slip hardly changes over a spot, stress there is D times slip with the D of the spot: the line carries as
// one whose D is the mean of D over the line, springs in parallel. With spots as long as the shear decays it does not.
TEST(ResinSpots, FineForTheShearButNotForGluePointsAreAMeanStiffness) {
  const auto panel = lap_joint();
  glue::Coverage coverage;
  coverage.mean = .4;
  std::vector<double> changes;
  const double c = coverage.mean, full = 1 / kCompliance;
  for (const double spot : {.1, .5, 8.}) {
    coverage.spot_mm = spot;
    double worst = 0, sum = 0;
    for (coverage.seed = 1; coverage.seed <= 4; ++coverage.seed) {
      const auto options = tension(kCompliance, coverage);
      double stiffness = 0;
      for (const auto& point : glue::cure(panel, options.curing))
        stiffness += point.area / (kCompliance + point.lacking);
      const double mean = modulus(panel, tension(kLap / stiffness, {}));
      worst = std::max(worst, std::abs(modulus(panel, options) / mean - 1));
      sum += stiffness / 4;
    }
    changes.push_back(worst);
    if (spot == .5) {  // seen by points of .05 mm: both faces are covered there, or one
      const double expected = c * c * full + 2 * c * (1 - c) / (kCompliance + glue::lacking(coverage, .5));
      report("stiffness of laps with spots of .5 mm, over that of the probabilities", sum / (kLap * expected),
             test::near(1, .15).because("four lines of 60 spots, sd .05; points at the ends of spots add .04"));
    }
  }
  report("modulus of a lap with spots of .1 mm, against the mean of its stiffness", changes[0], below(.03));
  report("the same with spots of 8 mm, which it does not follow", changes[2], test::above(3 * changes[0]));
}

}  // namespace
}  // namespace strandlab::vtest
