// Means of curves with the intervals of the mean, against those worked out by hand.
#include "strandlab/study/bands.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "strandlab/statistics/statistics.hpp"

namespace strandlab::study {
namespace {

// y = 2x and y = 4x on grids of their own: the mean is 3x, its standard error x, its interval t(.975, 1) x either way.
TEST(Band, IsTheMeanOfCurvesOnGridsOfTheirOwn) {
  const Curve slow{{0, 1, 4}, {0, 2, 8}}, fast{{0, 3, 4}, {0, 12, 16}};
  const auto band = band_of({slow, fast}, {0, .5, 2, 4});
  EXPECT_EQ(band.n, 2);
  for (std::size_t i = 0; i < band.x.size(); ++i) {
    const double x = band.x[i];
    EXPECT_NEAR(band.mean[i], 3 * x, 1e-14);
    EXPECT_NEAR(band.high[i] - band.mean[i], statistics::t_975(1) * x, 1e-12);
    EXPECT_NEAR(band.mean[i] - band.low[i], statistics::t_975(1) * x, 1e-12);
  }
}

// Beyond its ends a curve keeps its last values; one curve alone has no interval.
TEST(Band, OfOneCurveHasNoInterval) {
  const auto band = band_of({{{1, 2}, {10, 20}}}, {0, 1.5, 3});
  EXPECT_EQ(band.mean, (std::vector<double>{10, 15, 20}));
  EXPECT_TRUE(std::isnan(band.low[1]) && std::isnan(band.high[1]));
}

}  // namespace
}  // namespace strandlab::study
