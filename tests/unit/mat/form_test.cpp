// Random mats against the stationary process they are drawn from. Means are those of normal distributions cut at zero,
// m + s phi(m/s)/Phi(m/s); what a window sees of a stationary sequence follows from Campbell's formula.
#include "strandlab/mat/form.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "strandlab/core/error.hpp"
#include "strandlab/mat/row.hpp"

namespace strandlab::mat {
namespace {

const StrandStatistics kSurface{150, 20, 15, 4.95};
const StrandStatistics kCore{25, 3, 10, 1};
const StrandStatistics kWild{10, 9, 6, 5};  // truncation matters: means 11.5 and 6.9
constexpr int kMats = 2000;

Layup osb(int rows, double length_mm, const StrandStatistics& surface = kSurface,
          const StrandStatistics& core = kCore) {
  Layup layup;
  layup.length_mm = length_mm;
  for (int i = 0; i < rows; ++i) {
    const bool outer = i < rows / 4 || i >= rows - rows / 4;
    layup.rows.push_back(outer ? LayupRow{"surface", surface} : LayupRow{"core", core});
  }
  return layup;
}

double truncated_mean(double m, double s) {
  if (s == 0) return m;
  const double z = m / s;
  return m + s * std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi) / (0.5 * std::erfc(-z / std::sqrt(2.0)));
}
double mean_length(const StrandStatistics& s) {
  return truncated_mean(s.length_mm, s.length_sd_mm);
}
double mean_gap(const StrandStatistics& s) {
  return truncated_mean(s.gap_mm, s.gap_sd_mm);
}
double solid_fraction(const StrandStatistics& s) {
  return mean_length(s) / (mean_length(s) + mean_gap(s));
}

// Mean and standard error of independent observations.
struct Sample {
  double n = 0, sum = 0, sum2 = 0;
  void add(double x) {
    n += 1;
    sum += x;
    sum2 += x * x;
  }
  double mean() const { return sum / n; }
  double error() const { return std::sqrt((sum2 / n - mean() * mean()) / (n - 1)); }
};

class Process : public testing::TestWithParam<StrandStatistics> {};

// Strands (and gaps) that start in the window, taken whole, are an unbiased sample: for each row the sum of (L - <L>)
// over the strands that start in it has mean zero exactly, however many there are.
TEST_P(Process, MeanLengthAndGapOfTheStationarySequence) {
  const auto statistics = GetParam();
  const Ticks window = 100'000'000;
  Sample length, gap, starts;
  for (int seed = 0; seed < kMats; ++seed) {
    RandomStream random(static_cast<std::uint64_t>(seed), 0);
    const auto row = stationary_row(statistics, window, random);
    double length_excess = 0, gap_excess = 0;
    int count = 0;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (row[i].x0 >= 0 && row[i].x0 < window) {
        length_excess += static_cast<double>(row[i].x1 - row[i].x0) / kTicksPerMm - mean_length(statistics);
        ++count;
      }
      if (i + 1 < row.size() && row[i].x1 >= 0 && row[i].x1 < window) {
        gap_excess += static_cast<double>(row[i + 1].x0 - row[i].x1) / kTicksPerMm - mean_gap(statistics);
      }
    }
    length.add(length_excess);
    gap.add(gap_excess);
    starts.add(count);
  }
  EXPECT_LT(std::abs(length.mean()), 3 * length.error());
  EXPECT_LT(std::abs(gap.mean()), 3 * gap.error());
  EXPECT_NEAR(starts.mean(), 100 / (mean_length(statistics) + mean_gap(statistics)), 3 * starts.error());
}

TEST_P(Process, SolidFraction) {
  const auto statistics = GetParam();
  const auto layup = osb(4, 100, statistics, statistics);
  Sample solid;
  for (int seed = 0; seed < kMats; ++seed) {
    double sum = 0;
    for (const auto& layer : form(layup, static_cast<std::uint64_t>(seed)).layers) {
      for (const auto& strand : layer.strands) sum += strand.x1_mm - strand.x0_mm;
    }
    solid.add(sum / 400);
  }
  EXPECT_NEAR(solid.mean(), solid_fraction(statistics), 3 * solid.error());
}

// Stationarity: a strand covers each x with the same probability. One row of each mat is probed at one x only (mat i at
// probe i mod 20), so all observations are independent and chi-square has its textbook distribution: 20 binomials of
// known mean, 20 degrees of freedom, 99.9 % point 45.3.
TEST_P(Process, CoverageIsFlatAlongTheMat) {
  const auto statistics = GetParam();
  const auto layup = osb(4, 100, statistics, statistics);
  constexpr std::size_t kProbes = 20;
  std::array<double, kProbes> covered{}, tried{};
  for (std::size_t seed = 0; seed < kMats; ++seed) {
    const auto mat = form(layup, 100000 + seed);
    for (std::size_t row = 0; row < mat.layers.size(); ++row) {  // rows are independent
      const std::size_t probe = (seed + 5 * row) % kProbes;
      const double x = 100 * static_cast<double>(probe) / (kProbes - 1) * (1 - 1e-9);
      const auto& strands = mat.layers[row].strands;
      tried[probe] += 1;
      covered[probe] +=
          std::any_of(strands.begin(), strands.end(), [x](const Strand& s) { return s.x0_mm <= x && x < s.x1_mm; });
    }
  }
  const double p = solid_fraction(statistics);
  double chi2 = 0;
  for (std::size_t i = 0; i < kProbes; ++i) {
    chi2 += (covered[i] - p * tried[i]) * (covered[i] - p * tried[i]) / (tried[i] * p * (1 - p));
  }
  EXPECT_LT(chi2, 45.3);
}

INSTANTIATE_TEST_SUITE_P(Strands, Process, testing::Values(kSurface, kCore, kWild));

// The strand that covers x = 0 is length-biased: its mean length is <L^2>/<L> = m + s^2/m, not m.
TEST(StationaryRow, TheFirstStrandIsLengthBiased) {
  const StrandStatistics statistics{25, 6, 10, 1};  // truncation at 4 sd: below 1e-4 mm of the mean
  Sample length, covered;
  for (int seed = 0; seed < 20000; ++seed) {
    RandomStream random(static_cast<std::uint64_t>(seed), 1);
    const auto first = stationary_row(statistics, 1, random).front();
    covered.add(first.x1 > 0);
    if (first.x1 > 0) length.add(static_cast<double>(first.x1 - first.x0) / kTicksPerMm);
  }
  EXPECT_NEAR(length.mean(), 25 + 36.0 / 25, 3 * length.error());
  EXPECT_NEAR(covered.mean(), 25.0 / 35, 3 * covered.error());
}

TEST(Form, StrandsNeverOverlapAndStayInTheWindow) {
  const auto layup = osb(20, 100, kSurface, kWild);
  for (int seed = 0; seed < kMats; ++seed) {
    for (const auto& layer : form(layup, static_cast<std::uint64_t>(seed)).layers) {
      double end = 0;
      for (const auto& strand : layer.strands) {
        ASSERT_GE(strand.x0_mm, end);
        ASSERT_GT(strand.x1_mm, strand.x0_mm);
        ASSERT_LE(strand.x1_mm, 100);
        end = strand.x1_mm;
      }
    }
  }
}

TEST(Form, SameSeedSameBytes) {
  const auto layup = osb(20, 100);
  std::set<std::string> texts;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const auto text = to_text(form(layup, seed));
    EXPECT_EQ(text, to_text(form(layup, seed)));
    texts.insert(text);
  }
  EXPECT_EQ(texts.size(), 100U) << "two seeds gave one mat";
}

// Rows are keyed by (seed, row): adding rows on top leaves the lower ones as they were, and no two rows are alike.
TEST(Form, RowsAreIndependent) {
  const auto text_of = [](const Mat& mat, std::size_t row) {
    Mat one = mat;
    one.layers = {mat.layers[row]};
    return to_text(one);
  };
  Layup low, high;
  low.rows.assign(4, {"core", kCore});
  high.rows.assign(9, {"core", kCore});
  const auto a = form(low, 3), b = form(high, 3);
  std::set<std::string> rows;
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(text_of(a, i), text_of(b, i));
  for (std::size_t i = 0; i < 9; ++i) rows.insert(text_of(b, i));
  EXPECT_EQ(rows.size(), 9U);
}

// Printed once and compared for ever: no compiler, flag or machine may move a digit of a seed's mat.
TEST(Form, SameMatOnEveryMachine) {
  Layup layup;
  layup.length_mm = 60;
  layup.rows = {{"surface", kSurface}, {"core", kCore}};
  EXPECT_EQ(
      to_text(form(layup, 1)),
      "{\"length_mm\":60.0, \"layer_thickness_mm\":0.8,\n \"layers\":[\n"
      "  {\"role\":\"surface\", \"strands\":[{\"x0\":0.0,\"x1\":60.0}]},\n"
      "  {\"role\":\"core\", \"strands\":[{\"x0\":9.25764,\"x1\":34.300545}, {\"x0\":44.514642,\"x1\":60.0}]}\n ]}\n");
}

// Angles have a stream of their own: adding them moves no strand, and a mat without them names none.
TEST(Form, SameAnglesOnEveryMachine) {
  Layup layup;
  layup.length_mm = 60;
  layup.rows = {{"surface", kSurface}, {"core", kCore, {}, AngleDistribution{0, 90}}};
  EXPECT_EQ(to_text(form(layup, 1)),
            "{\"length_mm\":60.0, \"layer_thickness_mm\":0.8,\n \"layers\":[\n"
            "  {\"role\":\"surface\", \"strands\":[{\"x0\":0.0,\"x1\":60.0}]},\n"
            "  {\"role\":\"core\", \"strands\":[{\"x0\":9.25764,\"x1\":34.300545,\"angle_deg\":-18.643}, "
            "{\"x0\":44.514642,\"x1\":60.0,\"angle_deg\":-41.483}]}\n ]}\n");
}

// Chi-square of 18 bins over mean +- spread; 40.8 is exceeded by one sample of uniform angles in a thousand. Successive
// strands are independent: their correlation is within three of its standard errors, 1/sqrt(n).
TEST(Form, AnglesAreUniformAndIndependent) {
  constexpr int kBins = 18;
  for (const auto& range : {AngleDistribution{0, 90}, AngleDistribution{-20, 30}}) {
    Layup layup;
    layup.length_mm = 1000;
    layup.rows.assign(200, {"core", kCore, {}, range});
    std::vector<double> u;  // uniform in 0..1
    for (const auto& layer : form(layup, 7).layers) {
      for (const auto& strand : layer.strands)
        u.push_back((strand.angle_deg.value() - range.mean_deg + range.spread_deg) / (2 * range.spread_deg));
    }
    const auto n = static_cast<double>(u.size());
    ASSERT_GT(n, 5000);
    std::vector<double> count(kBins, 0.0);
    double correlation = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      ASSERT_TRUE(u[i] >= 0 && u[i] <= 1) << u[i];
      count[std::min<std::size_t>(kBins - 1, static_cast<std::size_t>(u[i] * kBins))] += 1;
      if (i > 0) correlation += 12 * (u[i] - .5) * (u[i - 1] - .5) / n;
    }
    double chi2 = 0;
    for (const double c : count) chi2 += (c - n / kBins) * (c - n / kBins) / (n / kBins);
    EXPECT_LT(chi2, 40.8);
    EXPECT_LT(std::abs(correlation), 3 / std::sqrt(n));
  }
}

// A row names its thickness only where it differs from the others'.
TEST(Form, RowsMayDifferInThickness) {
  Layup layup;
  layup.rows = {{"surface", kSurface, 1.25}, {"core", kCore, .8}, {"core", kCore}};
  const auto mat = form(layup, 1);
  EXPECT_EQ(mat.layers[0].thickness_mm, 1.25);
  EXPECT_FALSE(mat.layers[1].thickness_mm || mat.layers[2].thickness_mm);
  EXPECT_EQ(mat.height_below(1), 1.25);
  EXPECT_DOUBLE_EQ(mat.thickness_mm(), 1.25 + 2 * .8);
  EXPECT_EQ(thinnest_layer(mat), .8);
}

TEST(Through, IsWholeAndNearest) {
  EXPECT_EQ(through(.8, .8, 6), 6);
  EXPECT_EQ(through(1.2, .8, 6), 9);
  EXPECT_EQ(through(1.1, .8, 6), 8);  // 8.25
  EXPECT_EQ(through(1e9, 1e-3, 6), 1000000);
}

TEST(Form, WithoutGapsOneStrandFillsTheRow) {
  Layup layup;
  layup.length_mm = 33.25;
  layup.rows.assign(3, {"surface", {0, 0, 0, 0}});
  const auto mat = form(layup, 1);
  ASSERT_EQ(mat.layers.size(), 3U);
  for (const auto& layer : mat.layers) {
    ASSERT_EQ(layer.strands.size(), 1U);
    EXPECT_EQ(layer.strands[0].x0_mm, 0);
    EXPECT_EQ(layer.strands[0].x1_mm, 33.25);
  }
}

// Strands of fixed length that butt against each other: a gap of zero is a mat without gaps, cut at random places.
TEST(Form, ButtJoints) {
  Layup layup;
  layup.rows.assign(1, {"surface", {30, 0, 0, 0}});
  const auto strands = form(layup, 8).layers[0].strands;
  ASSERT_GE(strands.size(), 4U);
  EXPECT_EQ(strands.front().x0_mm, 0);
  EXPECT_EQ(strands.back().x1_mm, 100);
  for (std::size_t i = 1; i < strands.size(); ++i) EXPECT_EQ(strands[i].x0_mm, strands[i - 1].x1_mm);
  EXPECT_NEAR(strands[1].x1_mm - strands[1].x0_mm, 30, 1e-12);
}

struct BadLayup {
  const char* name;
  void (*spoil)(Layup&);
  std::vector<const char*> told;  // what the message must say
};

class FormRejects : public testing::TestWithParam<BadLayup> {};

TEST_P(FormRejects, WithOneClearMessage) {
  auto layup = osb(4, 100);
  GetParam().spoil(layup);
  try {
    form(layup, 1);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    for (const auto* words : GetParam().told) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Layups, FormRejects,
    testing::Values(
        BadLayup{"LengthSdAboveMean",
                 [](Layup& l) { l.rows[1].statistics.length_sd_mm = 26; },
                 {"row 2 (\"core\")", "length_sd_mm = 26", "length_mm = 25", "0 to 25"}},
        BadLayup{"GapSdAboveMean",
                 [](Layup& l) { l.rows[3].statistics.gap_sd_mm = 15.5; },
                 {"row 4 (\"surface\")", "gap_sd_mm = 15.5", "gap_mm = 15"}},
        BadLayup{"SpreadOfNoGap", [](Layup& l) { l.rows[0].statistics.gap_mm = 0; }, {"row 1", "gap_sd_mm = 4.95"}},
        BadLayup{"NegativeSd", [](Layup& l) { l.rows[0].statistics.gap_sd_mm = -1; }, {"gap_sd_mm = -1", "negative"}},
        BadLayup{"NegativeGap", [](Layup& l) { l.rows[0].statistics.gap_mm = -2; }, {"row 1", "gap_mm = -2"}},
        BadLayup{"ZeroLength", [](Layup& l) { l.rows[2].statistics.length_mm = 0; }, {"row 3", "length_mm = 0"}},
        BadLayup{
            "NanLength", [](Layup& l) { l.rows[2].statistics.length_mm = std::nan(""); }, {"row 3", "length_mm = nan"}},
        BadLayup{"NanSd", [](Layup& l) { l.rows[2].statistics.length_sd_mm = std::nan(""); }, {"length_sd_mm = nan"}},
        BadLayup{"NoWindow", [](Layup& l) { l.length_mm = 0; }, {"length_mm = 0"}},
        BadLayup{"NegativeThickness", [](Layup& l) { l.layer_thickness_mm = -0.8; }, {"layer_thickness_mm = -0.8"}},
        BadLayup{"NoThickness", [](Layup& l) { l.rows[1].thickness_mm = 0; }, {"row 2 (\"core\")", "thickness_mm = 0"}},
        BadLayup{"SpreadBeyondAnyAngle",
                 [](Layup& l) {
                   l.rows[1].angles = AngleDistribution{0, 91};
                 },
                 {"row 2 (\"core\")", "angle spread = 91", "between 0 and 90"}},
        BadLayup{"NegativeSpread",
                 [](Layup& l) {
                   l.rows[1].angles = AngleDistribution{0, -1};
                 },
                 {"angle spread = -1"}},
        BadLayup{"NanAngle",
                 [](Layup& l) {
                   l.rows[1].angles = AngleDistribution{std::nan(""), 1};
                 },
                 {"angle = nan"}},
        BadLayup{"NoRows", [](Layup& l) { l.rows.clear(); }, {"no rows"}},
        BadLayup{"NamelessKind", [](Layup& l) { l.rows[0].kind = ""; }, {"row 1", "no name"}},
        BadLayup{"WindowWithinAGap",
                 [](Layup& l) {
                   l.length_mm = 1;
                   l.rows.assign(40, {"core", {1, 0, 100, 0}});
                 },
                 {"window of 1 mm", "lies within one gap", "seed", "1"}}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace strandlab::mat
