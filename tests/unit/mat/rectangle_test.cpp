#include "strandlab/mat/rectangle.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "strandlab/core/random.hpp"

namespace strandlab::mat {
namespace {

using Corners = std::array<std::array<double, 2>, 4>;

Corners corners(const Rectangle& r, double dx, double dy) {
  Corners result{};
  const std::array<std::array<double, 2>, 4> signs{{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
  for (std::size_t k = 0; k < 4; ++k) {
    const double u = signs[k][0] * r.half_length, v = signs[k][1] * r.half_width;
    result[k] = {r.cx + dx + u * r.cos - v * r.sin, r.cy + dy + u * r.sin + v * r.cos};
  }
  return result;
}

bool holds(const Rectangle& r, const std::array<double, 2>& p) {
  const double x = p[0] - r.cx, y = p[1] - r.cy;
  return std::abs(x * r.cos + y * r.sin) < r.half_length && std::abs(y * r.cos - x * r.sin) < r.half_width;
}

// Another way to see an overlap: points of b on a fine raster that lie in a.
bool shares_points(const Rectangle& a, const Rectangle& b, double dx, double dy) {
  constexpr int kPoints = 60;
  const auto at = corners(b, dx, dy);
  for (int i = 0; i <= kPoints; ++i) {
    for (int j = 0; j <= kPoints; ++j) {
      const double u = static_cast<double>(i) / kPoints, v = static_cast<double>(j) / kPoints;
      std::array<double, 2> p{};
      for (std::size_t k = 0; k < 2; ++k) p[k] = at[0][k] + u * (at[1][k] - at[0][k]) + v * (at[3][k] - at[0][k]);
      if (holds(a, p)) return true;
    }
  }
  return false;
}

Rectangle random_rectangle(RandomStream& random) {
  return rectangle(40 * random.uniform(), 40 * random.uniform(), 5 + 20 * random.uniform(), 3 + 5 * random.uniform(),
                   360 * random.uniform());
}

// Against points of a raster, which miss only overlaps thinner than their spacing.
TEST(Rectangles, OverlapIsWhereTheySharePoints) {
  RandomStream random(3, 1);
  int met = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto a = random_rectangle(random), b = random_rectangle(random);
    const double apart = distance_apart(a, b);
    EXPECT_EQ(apart, distance_apart(b, a));
    if (std::abs(apart) < 0.5) continue;
    met += apart < 0;
    EXPECT_EQ(apart < 0, shares_points(a, b, 0, 0)) << i;
  }
  EXPECT_GT(met, 300);
}

// Parallel rectangles side by side and end to end: the distance is that between their edges.
TEST(Rectangles, DistanceOfParallelOnes) {
  for (const double angle : {0.0, 90.0, 33.3}) {
    const auto a = rectangle(0, 0, 20, 4, angle), b = rectangle(0, 0, 10, 2, angle);
    EXPECT_NEAR(distance_apart(a, b, -5 * a.sin, 5 * a.cos), 2, 1e-12);
    EXPECT_NEAR(distance_apart(a, b, 15.5 * a.cos, 15.5 * a.sin), 0.5, 1e-12);
    EXPECT_NEAR(distance_apart(a, b), -3, 1e-12);
  }
}

// All images, also those that only a strand longer than the window meets, against every image in a wide range.
TEST(Rectangles, FindsEveryImageThatOverlaps) {
  RandomStream random(3, 2);
  int met = 0, own = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto a = random_rectangle(random), b = random_rectangle(random);
    const Window window{6 + 40 * random.uniform(), 6 + 40 * random.uniform(), true};
    bool any = false, any_own = false;
    for (int x = -15; x <= 15; ++x) {
      for (int y = -15; y <= 15; ++y) {
        any = any || distance_apart(a, b, x * window.x, y * window.y) < 0.2;
        any_own = any_own || ((x || y) && distance_apart(a, a, x * window.x, y * window.y) < 0.2);
      }
    }
    const auto found = image_within(0.2, a, b, window);
    EXPECT_EQ(found.has_value(), any) << i;
    if (found) {
      EXPECT_LT(distance_apart(a, b, found->i * window.x, found->j * window.y), 0.2);
    }
    EXPECT_EQ(own_image_within(0.2, a, window).has_value(), any_own) << i;
    met += any;
    own += any_own;
  }
  EXPECT_GT(met, 200);
  EXPECT_LT(met, 1800);
  EXPECT_GT(own, 200);
  EXPECT_LT(own, 1800);
}

TEST(Rectangles, APlaneHasNoImages) {
  const auto a = rectangle(5, 5, 8, 2, 0), b = rectangle(95, 5, 8, 2, 0);
  EXPECT_FALSE(image_within(3, a, b, {100, 10, false}));
  const auto image = image_within(3, a, b, {100, 10, true});
  ASSERT_TRUE(image);
  EXPECT_EQ(image->i, -1);
  EXPECT_FALSE(own_image_within(3, a, {100, 4, false}));
  EXPECT_TRUE(own_image_within(3, a, {100, 4, true}));
}

}  // namespace
}  // namespace strandlab::mat
