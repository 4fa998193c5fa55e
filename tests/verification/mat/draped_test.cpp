#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "strandlab/mat/drape.hpp"
#include "strandlab/mat/plate_form.hpp"
#include "support/report.hpp"
#include "support/sample.hpp"

// Random deposition of strands 150 x 25 mm against its closed-form statistics (Dai & Steiner, Wood Sci. Technol. 28
// (1994) 135-146), and draped heights against those of an independent program.
namespace strandlab::mat {
namespace {

constexpr int kWindow = 1016;  // mm, of a torus so large that a fixed number of strands is next to a Poisson one
constexpr double kCount = 20;  // strands over a point

// Strands over the points of a raster of 1 mm.
std::vector<double> counts(const PlateMat& mat) {
  std::vector<double> count(static_cast<std::size_t>(kWindow) * kWindow, 0.0);
  const auto wrapped = [](long k) { return static_cast<std::size_t>((k % kWindow + kWindow) % kWindow); };
  for (const auto& layer : mat.layers) {
    for (const auto& s : layer.strands) {
      const auto r = outline(s, s.angle_deg.value());
      const double reach_x = r.half_length * std::abs(r.cos) + r.half_width * std::abs(r.sin);
      const double reach_y = r.half_length * std::abs(r.sin) + r.half_width * std::abs(r.cos);
      for (long j = std::lround(r.cy - reach_y); j <= std::lround(r.cy + reach_y); ++j) {
        for (long i = std::lround(r.cx - reach_x); i <= std::lround(r.cx + reach_x); ++i) {
          const double x = static_cast<double>(i) - r.cx, y = static_cast<double>(j) - r.cy;
          if (std::abs(x * r.cos + y * r.sin) < r.half_length && std::abs(y * r.cos - x * r.sin) < r.half_width)
            ++count[wrapped(i) + kWindow * wrapped(j)];
        }
      }
    }
  }
  return count;
}

// Variance of the mean count of zones of size x size mm about the mat's mean, over that mean.
double zone_variance(const std::vector<double>& count, int size, double mean) {
  const int zones = kWindow / size;
  double sum = 0;
  for (int zy = 0; zy < zones; ++zy) {
    for (int zx = 0; zx < zones; ++zx) {
      double total = 0;
      for (int j = zy * size; j < (zy + 1) * size; ++j) {
        for (int i = zx * size; i < (zx + 1) * size; ++i) total += count[static_cast<std::size_t>(i + kWindow * j)];
      }
      sum += std::pow(total / (size * size) - mean, 2);
    }
  }
  return sum / (zones * zones) / mean;
}

PlateMat deposited(const AngleDistribution& angles, std::uint64_t seed) {
  PlateLayup layup;
  layup.length_mm = layup.width_mm = kWindow;
  layup.stack = Stack::kDraped;
  layup.rows.assign(static_cast<std::size_t>(kCount), {"surface", {}, angles});
  return form(layup, seed).mat;
}

constexpr std::array<int, 3> kZones{10, 50, 100};  // mm

// V(D) of Dai & Steiner for zones of 10, 50 and 100 mm. A fixed number of strands takes off L B over the window.
void compare_zones(const std::string& name, const AngleDistribution& angles, const std::array<double, 3>& expected) {
  std::array<test::Sample, 3> variance;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const auto mat = deposited(angles, seed);
    const auto count = counts(mat);
    for (std::size_t k = 0; k < kZones.size(); ++k)
      variance[k].add(zone_variance(count, kZones[k], coverage(mat, 0)) + 150.0 * 25 / (kWindow * kWindow));
  }
  for (std::size_t k = 0; k < kZones.size(); ++k) {
    report("V of zones of " + std::to_string(kZones[k]) + " mm, " + name, variance[k].mean(),
           test::near(expected[k], 3 * variance[k].error() + 1e-3).because("three standard errors and the raster"));
  }
}

TEST(Deposition, DensityOfZonesNormalAngles) {
  compare_zones("normal(25)", {0, 0, 25}, {.84779, .37177, .17646});
}
TEST(DepositionNightly, DensityOfZonesAligned) {
  compare_zones("all along", {}, {.84741, .37037, .17824});
}
TEST(DepositionNightly, DensityOfZonesAnyAngle) {
  compare_zones("any angle", {0, 90}, {.84793, .37233, .17610});
}

// Strands over a point are Poisson: mean and variance 20, and columns that carry at a compaction C, of at least (1 - C)
// 20 strands, are .530 .844 .979 .995 of all, their interfaces .623 .898 .990 .998.
TEST(Deposition, CountsArePoisson) {
  const std::array<double, 4> compactions{0, .2, .4, .5}, columns{.530, .844, .979, .995},
      faces{.623, .898, .990, .998};
  test::Sample variance;
  std::array<test::Sample, 4> carrying, interfaces;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const auto mat = deposited({0, 0, 25}, seed);
    EXPECT_NEAR(coverage(mat, 0), kCount, 0.5 * 150 * 25 / (kWindow * kWindow) + 1e-9);
    const auto count = counts(mat);
    const auto n = static_cast<double>(count.size());
    double squares = 0, all_faces = 0;
    std::array<double, 4> share{}, face_share{};
    for (const double k : count) {
      squares += (k - kCount) * (k - kCount) / n;
      all_faces += std::max(0.0, k - 1);
      for (std::size_t c = 0; c < 4; ++c) {
        if (k < (1 - compactions[c]) * kCount - 1e-9) continue;
        share[c] += 1 / n;
        face_share[c] += k - 1;
      }
    }
    variance.add(squares / kCount);
    for (std::size_t c = 0; c < 4; ++c) {
      carrying[c].add(share[c]);
      interfaces[c].add(face_share[c] / all_faces);
    }
  }
  report("variance of the strands over a point over their mean", variance.mean(),
         test::near(1, 3 * variance.error() + 150.0 * 25 / (kWindow * kWindow)).because("three standard errors"));
  for (std::size_t c = 0; c < 4; ++c) {
    const auto at = " at compaction " + test::number(compactions[c]);
    report("columns that carry" + at, carrying[c].mean(),
           test::near(columns[c], 3 * carrying[c].error() + 1e-3).because("three standard errors and rounding"));
    report("interfaces in columns that carry" + at, interfaces[c].mean(),
           test::near(faces[c], 3 * interfaces[c].error() + 1e-3).because("three standard errors and rounding"));
  }
}

struct Slopes {
  double along, across;
  double solid_mean, solid_highest, touching;  // of the other program's mat
};

// Ten strands over a point, angles normal(25), torus of 254 mm: mean of mats over the other program's one. Its one mat
// scatters by a tenth, and its raster is another: cells of .54 mm here, to which heights tend slowly.
void compare_drapes(const std::vector<Slopes>& slopes, std::uint64_t mats) {
  for (const auto& s : slopes) {
    double mean_top = 0, highest = 0, touching = 0;
    for (std::uint64_t seed = 1; seed <= mats; ++seed) {
      PlateLayup layup;
      layup.stack = Stack::kDraped;
      layup.drape_slopes = {s.along, s.across};
      layup.rows.assign(10, {"surface", {}, {0, 0, 25}});
      const auto mat = form(layup, seed).mat;
      const auto drape_of_it = drape(mat, {{"surface", 0}}, 0.535);
      const double wood = coverage(mat, 0) * mat.layer_thickness_mm, n = static_cast<double>(mats);
      mean_top += wood / drape_of_it.mean_top_mm / s.solid_mean / n;
      highest += wood / drape_of_it.highest_mm / s.solid_highest / n;
      touching += drape_of_it.touching / s.touching / n;
    }
    const auto name = " of mats draped with slopes " + test::number(s.along) + " and " + test::number(s.across) +
                      ", over that of another program's one mat";
    const auto band = test::near(1, 0.25).because("one mat of the other program, on another raster");
    report("solid fraction below the mean top" + name, mean_top, band);
    report("solid fraction below the highest point" + name, highest, band);
    report("faces that touch" + name, touching, band);
  }
}

TEST(Draping, HeightsAreThoseOfAnotherProgram) {
  compare_drapes({{.1, .2, .643, .403, .40}}, 2);
}
TEST(DrapingNightly, HeightsAreThoseOfAnotherProgram) {
  compare_drapes({{0, 0, .147, .133, .19}, {.05, .1, .488, .378, .32}, {.2, .4, .794, .418, .63}}, 6);
}

}  // namespace
}  // namespace strandlab::mat
