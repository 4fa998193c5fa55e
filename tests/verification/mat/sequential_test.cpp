#include "strandlab/mat/sequential.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/report.hpp"
#include "support/sample.hpp"

// Layers of random sequential addition on a torus, strands 150 x 25 mm without clearance unless it says so, against an
// independent program's means over its layers. Bands are three standard errors of the difference of the two means.
namespace strandlab::mat {
namespace {

struct Mean {
  double value = 0, error = 0;
};

struct Expected {
  Mean coverage, strands;
  double mean_off_deg = 0;  // mean |angle - mean| of placed strands
};

struct Layers {
  std::string name;
  double window_mm = 254;
  SizeStatistics sizes;
  AngleDistribution angles;
  int failures = 20000, layers = 200;
  Expected expected;
};

void compare(const Layers& what) {
  const Window torus{what.window_mm, what.window_mm, true};
  const PlateRow row{"surface", what.sizes, what.angles};
  test::Sample coverage, strands, off;
  for (int i = 0; i < what.layers; ++i) {
    const auto layer = sequential_layer(row, torus, {0, what.failures, false}, RandomStream(1, i));
    double area = 0;
    for (const auto& s : layer.strands) {
      area += s.length_mm * s.width_mm;
      off.add(off_angle(s.angle_deg.value(), what.angles.mean_deg));
    }
    coverage.add(area / (torus.x * torus.y));
    strands.add(static_cast<double>(layer.strands.size()));
  }
  const auto band = [](const test::Sample& sample, const Mean& mean) {
    return test::near(mean.value, 3 * std::hypot(sample.error(), mean.error)).because("three standard errors");
  };
  const auto& expected = what.expected;
  report("covered part of a layer, " + what.name, coverage.mean(), band(coverage, expected.coverage));
  report("strands in a layer, " + what.name, strands.mean(), band(strands, expected.strands));
  if (expected.mean_off_deg > 0)  // of as many strands, with an error like ours
    report("mean angle of placed strands, " + what.name, off.mean(), band(off, {expected.mean_off_deg, off.error()}),
           "degrees");
}

TEST(SequentialLayers, ShortStrandsOnASmallTorus) {
  compare({"40 x 8 mm on a torus of 60 mm, angles normal(25)",
           60,
           {40, 0, 8, 0},
           {0, 0, 25},
           20000,
           200,
           {{.4938, .0035}, {5.55, .05}, 18.2}});
}
TEST(SequentialLayersNightly, ShorterStrandsOnASmallTorus) {
  compare({"24 x 6 mm on a torus of 60 mm, angles normal(25)",
           60,
           {24, 0, 6, 0},
           {0, 0, 25},
           20000,
           200,
           {{.4944, .0024}, {12.36, .06}, 18.5}});
}
TEST(SequentialLayers, FewAttempts) {
  compare({"torus of 254 mm, normal(25), 2 000 failures",
           254,
           {},
           {0, 0, 25},
           2000,
           200,
           {{.4516, .0030}, {7.77, .05}, 17.9}});
}
TEST(SequentialLayersNightly, Aligned) {
  compare({"torus of 254 mm, all along", 254, {}, {}, 20000, 200, {{.4380, .0024}, {7.54, .04}, 0}});
}
TEST(SequentialLayersNightly, NormalAngles) {
  compare({"torus of 254 mm, normal(25)", 254, {}, {0, 0, 25}, 20000, 200, {{.4845, .0027}, {8.34, .05}, 18.5}});
}
TEST(SequentialLayersNightly, WideAngles) {
  compare({"torus of 254 mm, normal(90)", 254, {}, {0, 0, 90}, 20000, 200, {{.4679, .0030}, {8.05, .05}, 44.7}});
}
TEST(SequentialLayersNightly, AnyAngle) {
  compare({"torus of 254 mm, any angle", 254, {}, {0, 90}, 20000, 200, {{.4609, .0029}, {7.93, .05}, 45.4}});
}
TEST(SequentialLayersNightly, StrandsOfManySizes) {
  compare({"torus of 254 mm, 150 +- 20 x 25 +- 3 mm, normal(25)",
           254,
           {150, 20, 25, 3},
           {0, 0, 25},
           20000,
           200,
           {{.5023, .0026}, {9.56, .07}, 17.7}});
}
TEST(SequentialLayersNightly, ManyAttempts) {
  compare({"torus of 254 mm, normal(25), 200 000 failures",
           254,
           {},
           {0, 0, 25},
           200000,
           100,
           {{.4993, .0044}, {8.59, .08}, 17.1}});
}
TEST(SequentialLayersNightly, LargeTorusAligned) {
  compare({"torus of 508 mm, all along", 508, {}, {}, 20000, 60, {{.5658, .0040}, {38.9, .28}, 0}});
}
TEST(SequentialLayersNightly, LargeTorus) {
  compare({"torus of 508 mm, normal(25)", 508, {}, {0, 0, 25}, 20000, 60, {{.4669, .0026}, {32.1, .18}, 18.0}});
}
TEST(SequentialLayersNightly, LargeTorusWideAngles) {
  compare({"torus of 508 mm, normal(90)", 508, {}, {0, 0, 90}, 20000, 60, {{.4546, .0035}, {31.3, .24}, 43.9}});
}
TEST(SequentialLayersNightly, LargestTorusAligned) {
  compare({"torus of 1016 mm, all along", 1016, {}, {}, 20000, 15, {{.5469, .0034}, {150.5, .95}, 0}});
}
TEST(SequentialLayers, LargestTorus) {
  compare({"torus of 1016 mm, normal(25)", 1016, {}, {0, 0, 25}, 20000, 15, {{.4604, .0030}, {126.7, .85}, 17.8}});
}

}  // namespace
}  // namespace strandlab::mat
