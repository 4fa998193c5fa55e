#include "strandlab/glue/coverage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "strandlab/core/error.hpp"
#include "strandlab/glue/glue.hpp"

namespace strandlab::glue {
namespace {

// The measured classes, and between them; below the first stiffness falls as coverage does.
TEST(Coverage, LacksWhatWasMeasured) {
  const Coverage coverage;
  EXPECT_DOUBLE_EQ(lacking(coverage, .01), .01628);
  EXPECT_DOUBLE_EQ(lacking(coverage, .25), .01048);
  EXPECT_EQ(lacking(coverage, 1), 0);
  EXPECT_DOUBLE_EQ(lacking(coverage, .13), .5 * (.01628 + .01048));
  EXPECT_DOUBLE_EQ(lacking(coverage, .625), .5 * .01048);
  EXPECT_DOUBLE_EQ(lacking(coverage, .001), .1628);
  EXPECT_EQ(lacking(coverage, 0), std::numeric_limits<double>::infinity());
  Coverage pva;
  pva.compliances = {.14645, .06536, .03693};  // over that of faces covered whole
  EXPECT_NEAR(lacking(pva, .25), .06536 - .03693, 1e-15);
  EXPECT_NEAR(lacking(pva, 1), 0, 1e-15);
}

TEST(Coverage, IsRefusedWhereItCannotBe) {
  const auto refused = [](const auto& change) {
    Coverage coverage;
    change(coverage);
    EXPECT_THROW(check(coverage), InputError);
  };
  EXPECT_NO_THROW(check(Coverage()));
  for (const double mean : {0., -1., 1.1, std::nan("")}) refused([&](Coverage& c) { c.mean = mean; });
  for (const double spot : {-1., std::nan(""), std::numeric_limits<double>::infinity()})
    refused([&](Coverage& c) { c.spot_mm = spot; });
  refused([](Coverage& c) { c.classes = {.01, .25}; });         // fewer than compliances
  refused([](Coverage& c) { c.classes = {.01, .25, .9}; });     // never covered whole
  refused([](Coverage& c) { c.classes = {.25, .01, 1}; });      // not increasing
  refused([](Coverage& c) { c.compliances = {.01, .02, 0}; });  // more resin, softer bond
  refused([](Coverage& c) { c.compliances = {.02, .01, -.01}; });
}

// Covered length of a long face: mean c L; of a Boolean model of segments s of intensity k = -ln(1 - c)/s its variance
// is 2 L (1 - c)^2 ((exp(k s) - 1)/k - s). Within three standard deviations, for spots long and short, few and many.
TEST(Spots, CoverAsMuchAsABooleanModel) {
  constexpr double kLength = 1e5;
  std::uint64_t face = 0;
  for (const double spot : {.3, 5.}) {
    for (const double mean : {.01, .25, .9}) {
      Coverage coverage;
      coverage.mean = mean;
      coverage.spot_mm = spot;
      const double k = -std::log1p(-mean) / spot;
      const double variance = 2 * kLength * (1 - mean) * (1 - mean) * (std::expm1(k * spot) / k - spot);
      const Spots spots(coverage, kLength, face++);
      EXPECT_NEAR(spots.covered(0, kLength) * kLength, mean * kLength, 3 * std::sqrt(variance)) << spot << " " << mean;
    }
  }
}

TEST(Spots, AreTheSameForASeedAndOthersForAnother) {
  Coverage coverage;
  coverage.mean = .4;
  coverage.spot_mm = 1;
  const Spots spots(coverage, 50, 3), again(coverage, 50, 3), of_another_face(coverage, 50, 4);
  coverage.seed = 2;
  const Spots of_another_seed(coverage, 50, 3);
  double sum = 0;
  int others = 0;
  for (int i = 0; i < 100; ++i) {
    const double here = spots.covered(.5 * i, .5 * (i + 1));
    EXPECT_EQ(here, again.covered(.5 * i, .5 * (i + 1)));
    if (here != of_another_face.covered(.5 * i, .5 * (i + 1))) ++others;
    if (here != of_another_seed.covered(.5 * i, .5 * (i + 1))) ++others;
    sum += .5 * here;
  }
  EXPECT_NEAR(sum, 50 * spots.covered(0, 50), 1e-12);
  EXPECT_GT(others, 50);
}

}  // namespace
}  // namespace strandlab::glue
