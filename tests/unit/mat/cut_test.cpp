// What a section shows of whole strands, against integral geometry: a line meets a rectangle in proportion to its
// extent across the line, and what it cuts off is a trapezoid of the line's place within that extent.
#include "strandlab/mat/cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "strandlab/core/error.hpp"
#include "strandlab/mat/row.hpp"

namespace strandlab::mat {
namespace {

StrandStatistics whole(double length, double length_sd, double width, double width_sd) {
  return {length, length_sd, 10, 1, width, width_sd};
}
const StrandStatistics kWhole = whole(120, 15, 20, 3);

struct Moments {
  double n = 0, sum = 0, square = 0;
  void add(double x, double weight = 1) {
    n += weight;
    sum += weight * x;
    square += weight * x * x;
  }
  double mean() const { return sum / n; }
  double sd() const { return std::sqrt(square / n - mean() * mean()); }
};

TEST(Cut, StrandsAlongAndAcrossShowLengthAndWidthWithTheirSpread) {
  for (const double angle : {0., 180., -180.}) {
    const auto shown = in_section(kWhole, {angle});
    EXPECT_EQ(shown.length_mm, 120);
    EXPECT_EQ(shown.length_sd_mm, 15);
    EXPECT_EQ(shown.width_mm, 0);
    EXPECT_FALSE(are_cut(kWhole, {angle}));
  }
  for (const double angle : {90., -90.}) {
    const auto shown = in_section(kWhole, {angle});
    EXPECT_EQ(shown.length_mm, 20);
    EXPECT_EQ(shown.length_sd_mm, 3);
    EXPECT_EQ(shown.gap_sd_mm, 1);
    EXPECT_FALSE(are_cut(kWhole, {angle}));
  }
  EXPECT_TRUE(are_cut(kWhole, {90, 0, 1}));
  const StrandStatistics plain{120, 15, 10, 1};
  EXPECT_FALSE(are_cut(plain, {30}));
  EXPECT_EQ(in_section(plain, {30}).length_mm, 120) << "without a width: as given, at any angle";
}

// A strand of 100 x 20 mm at 30 degrees: extents 50 and 17.3 mm across the line, so that a line cuts both long sides
// with probability (50 - 17.3)/(50 + 17.3), over 20/sin 30 = 40 mm; <c> = 100 x 20/(50 + 17.3).
TEST(Cut, OfOneStrandAtOneAngle) {
  const auto strand = whole(100, 0, 20, 0);
  const double ends = 20 * std::sqrt(3) / 2, extent = 50 + ends;
  const auto shown = in_section(strand, {30});
  EXPECT_NEAR(shown.length_mm, 2000 / extent, 1e-12);
  EXPECT_NEAR(shown.length_sd_mm, std::sqrt(1600 * (50 - ends + 2 * ends / 3) / extent - std::pow(2000 / extent, 2)),
              1e-9);
  const CutSource source(strand, {30});
  RandomStream random(3, 0);
  constexpr int kCuts = 40000;
  Moments cuts;
  double longest = 0;
  for (int i = 0; i < kCuts; ++i) {
    const auto cut = source.draw(random);
    EXPECT_EQ(cut.angle_deg, 30);
    ASSERT_GT(cut.length_mm, 0);
    ASSERT_LT(cut.length_mm, 40 * (1 + 1e-12));
    longest += cut.length_mm > 40 - 1e-9;
    cuts.add(cut.length_mm);
  }
  const double p = (50 - ends) / extent;
  EXPECT_NEAR(longest / kCuts, p, 3 * std::sqrt(p * (1 - p) / kCuts));
  EXPECT_NEAR(cuts.mean(), shown.length_mm, 3 * shown.length_sd_mm / std::sqrt(kCuts));
  EXPECT_NEAR(cuts.sd(), shown.length_sd_mm, .02 * shown.length_sd_mm);  // three errors of a standard deviation
}

// Rectangles of random length, width and angle thrown on a plane and cut by the line y = 0, each side by itself: an
// independent way to the same population. Means agree within three standard errors of both.
TEST(Cut, AsOfRectanglesThrownOnAPlane) {
  for (const auto& angles : {AngleDistribution{0, 0, 25}, AngleDistribution{90, 0, 25}, AngleDistribution{0, 90}}) {
    constexpr int kCuts = 30000;
    const CutSource source(kWhole, angles);
    RandomStream random(5, 0), thrown_random(5, 1);
    Moments drawn, turned;
    for (int i = 0; i < kCuts; ++i) {
      const auto cut = source.draw(random);
      drawn.add(cut.length_mm);
      turned.add(std::abs(std::cos(cut.angle_deg * std::numbers::pi / 180)));
    }
    Moments thrown, thrown_turned;
    const AngleSampler sampler(angles);
    while (thrown.n < kCuts) {
      const double length = thrown_random.positive_normal(120, 15), width = thrown_random.positive_normal(20, 3);
      const double angle = sampler.draw(thrown_random) * std::numbers::pi / 180;
      const double y = 300 * (thrown_random.uniform() - .5);  // of the centre, beyond the reach of every strand
      double from = INFINITY, to = -INFINITY;
      const double c = std::cos(angle), s = std::sin(angle);
      double px[4], py[4];
      for (int k = 0; k < 4; ++k) {
        const double u = (k == 0 || k == 3 ? -.5 : .5) * length, v = (k < 2 ? -.5 : .5) * width;
        px[k] = u * c - v * s;
        py[k] = y + u * s + v * c;
      }
      for (int k = 0; k < 4; ++k) {
        const int next = (k + 1) % 4;
        if ((py[k] > 0) == (py[next] > 0)) continue;
        const double x = px[k] + (px[next] - px[k]) * py[k] / (py[k] - py[next]);
        from = std::min(from, x);
        to = std::max(to, x);
      }
      if (!(to > from)) continue;
      thrown.add(to - from);
      thrown_turned.add(std::abs(c));
    }
    const double error = std::sqrt((std::pow(drawn.sd(), 2) + std::pow(thrown.sd(), 2)) / kCuts);
    EXPECT_NEAR(drawn.mean(), thrown.mean(), 3 * error);
    EXPECT_NEAR(drawn.sd(), thrown.sd(), .03 * thrown.sd());
    EXPECT_NEAR(turned.mean(), thrown_turned.mean(),
                3 * std::sqrt((std::pow(turned.sd(), 2) + std::pow(thrown_turned.sd(), 2)) / kCuts));
    EXPECT_NEAR(drawn.mean(), in_section(kWhole, angles).length_mm, 3 * drawn.sd() / std::sqrt(kCuts));
  }
}

// By length in the section strands have the angles of whole strands: each is met in proportion to its extent, and cut
// over its area divided by that extent. So <cos 2 angle> by length is exp(-2 sd^2) of a normal distribution.
TEST(Cut, ByLengthAnglesAreThoseOfWholeStrands) {
  const CutSource source(kWhole, {0, 0, 25});
  RandomStream random(7, 0);
  Moments turned;
  for (int i = 0; i < 60000; ++i) {
    const auto cut = source.draw(random);
    turned.add(std::cos(2 * cut.angle_deg * std::numbers::pi / 180), cut.length_mm);
  }
  const double sd = 25 * std::numbers::pi / 180;
  EXPECT_NEAR(turned.mean(), std::exp(-2 * sd * sd), .01);  // three standard errors of so many
}

// The row is stationary with cuts too: its wood is <c>/(<c> + <gap>), its strands name their angles.
TEST(Cut, WoodOfARow) {
  Layup layup;
  layup.length_mm = 100;
  layup.rows.assign(20, {"core", kWhole, {}, AngleDistribution{90, 0, 25}});
  Moments wood;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    for (const auto& layer : form(layup, seed).layers) {
      double sum = 0;
      for (const auto& strand : layer.strands) {
        sum += strand.x1_mm - strand.x0_mm;
        ASSERT_TRUE(strand.angle_deg.has_value());
      }
      wood.add(sum / 100);
    }
  }
  const auto shown = in_section(kWhole, {90, 0, 25});
  EXPECT_NEAR(wood.mean(), shown.length_mm / (shown.length_mm + 10), 3 * wood.sd() / std::sqrt(wood.n));
}

// Printed once and compared for ever, as those of FormTest are.
TEST(Cut, SameMatOnEveryMachine) {
  Layup layup;
  layup.length_mm = 60;
  layup.rows = {{"core", kWhole, {}, AngleDistribution{90, 0, 25}}};
  EXPECT_EQ(to_text(form(layup, 1)),
            "{\"length_mm\":60.0, \"layer_thickness_mm\":0.8,\n \"layers\":[\n"
            "  {\"role\":\"core\", \"strands\":[{\"x0\":0.943188,\"x1\":21.211636,\"angle_deg\":63.336}, "
            "{\"x0\":32.826356,\"x1\":60.0,\"angle_deg\":68.922}]}\n ]}\n");
}

TEST(Cut, RejectsAWidthWithoutMeaning) {
  Layup layup;
  layup.rows = {{"core", whole(120, 15, 20, 21)}};
  EXPECT_THROW(form(layup, 1), InputError);
  layup.rows = {{"core", {0, 0, 0, 0, 20, 0}}};
  EXPECT_THROW(form(layup, 1), InputError);
}

}  // namespace
}  // namespace strandlab::mat
