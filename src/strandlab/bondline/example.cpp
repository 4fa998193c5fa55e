#include "strandlab/bondline/example.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>

#include "strandlab/bondline/shear_lag.hpp"
#include "strandlab/core/random.hpp"
#include "strandlab/statistics/statistics.hpp"

namespace strandlab::bondline {
namespace {

// n log-normal values at evenly spaced probabilities with the given mean and coefficient of variation of the sample.
std::vector<double> log_normal(int n, double mean, double variation) {
  const auto values = [n](double sigma) {
    std::vector<double> result(n);
    for (int i = 0; i < n; ++i) result[i] = std::exp(sigma * normal_quantile((i + 0.5) / n));
    return result;
  };
  const auto excess = [&](double sigma) {
    const statistics::Summary s = statistics::summarise(values(sigma));
    return s.sd / s.mean - variation;
  };
  std::uintmax_t iterations = 100;
  const auto sigma =
      boost::math::tools::toms748_solve(excess, 1e-3, 20.0, boost::math::tools::eps_tolerance<double>(40), iterations);
  std::vector<double> result = values(sigma.first);
  const double scale = mean / statistics::summarise(result).mean;
  for (double& value : result) value *= scale;
  return result;
}

void shuffle(std::vector<double>& values, RandomStream& random) {
  for (std::size_t i = values.size(); i > 1; --i)
    std::swap(values[i - 1], values[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
}

double rounded(double value, double step) {
  return std::round(value / step) * step;
}

Geometry strands(const PublishedGroup& group, RandomStream& random) {
  const double E = group.strands == std::string("VTC") ? 24311 : 9936;  // MPa, Le (2010) Table 3.4
  constexpr double kVariation = 935.0 / 9936;
  Geometry g;
  g.E1_MPa = rounded(E * (1 + kVariation * random.normal()), 1);
  g.E2_MPa = rounded(E * (1 + kVariation * random.normal()), 1);
  g.t1_mm = rounded(0.69 + 0.02 * random.normal(), 0.001);
  g.t2_mm = rounded(0.69 + 0.02 * random.normal(), 0.001);
  g.W_mm = rounded(6 + 0.05 * random.normal(), 0.01);
  g.l_mm = rounded(25 + 0.2 * random.normal(), 0.01);
  g.L1_mm = rounded(5 + 0.2 * random.normal(), 0.01);
  g.L2_mm = rounded(5 + 0.2 * random.normal(), 0.01);
  return g;
}

std::string group_rows(const PublishedGroup& group, RandomStream& random) {
  std::vector<Geometry> specimens;
  double own_shear = 0;  // mean shear compliance of the strands
  for (int i = 0; i < group.n; ++i) {
    specimens.push_back(strands(group, random));
    own_shear -= lower_bound_mm_per_MPa(specimens.back()) / group.n;
  }
  const double t = statistics::t_975(group.n - 1);
  const double sd = group.half_interval * std::sqrt(group.n) / t, mean = group.mean + own_shear;
  std::vector<double> total = log_normal(group.n, mean, std::min(sd / mean, kLargestVariation));
  shuffle(total, random);
  std::string rows;
  for (int i = 0; i < group.n; ++i) {
    const Geometry& g = specimens[i];
    const double k = stiffness_N_per_mm(g, total[i] + lower_bound_mm_per_MPa(g));
    rows += fmt::format(
        "{0}-{1},{0},{2},{3},{4},{5:.0f},{6:.0f},{7:.3f},{8:.3f},{9:.2f},{10:.2f},{11:.2f},{12:.2f},{13:.3f}\n",
        group.name, i + 1, group.resin, group.strands, group.coverage_percent, g.E1_MPa, g.E2_MPa, g.t1_mm, g.t2_mm,
        g.W_mm, g.l_mm, g.L1_mm, g.L2_mm, k);
  }
  return rows;
}

}  // namespace

const std::vector<PublishedGroup>& published_groups() {
  static const std::vector<PublishedGroup> kGroups{
      {"PF-1", "PF", "normal", 1, 0.01628, 0.01406, 22},      {"PF-25", "PF", "normal", 25, 0.01048, 0.00995, 22},
      {"PF-100", "PF", "normal", 100, -0.00022, 0.00042, 22}, {"VTC-PF-1", "PF", "VTC", 1, 0.01177, 0.00640, 20},
      {"VTC-PF-25", "PF", "VTC", 25, 0.00210, 0.00343, 20},   {"VTC-PF-100", "PF", "VTC", 100, -0.00017, 0.00032, 20},
      {"PVA-1", "PVA", "normal", 1, 0.14645, 0.05617, 17},    {"PVA-25", "PVA", "normal", 25, 0.06536, 0.01832, 16},
      {"PVA-100", "PVA", "normal", 100, 0.03693, 0.01963, 15}};
  return kGroups;
}

std::string example_table(std::uint64_t seed) {
  std::string table =
      "# Made-up specimens with the means and scatter of Le (2010) Table 2.1; strandlab bondline --example\n"
      "id,group,resin,strands,coverage_percent,E1_MPa,E2_MPa,t1_mm,t2_mm,W_mm,l_mm,L1_mm,L2_mm,k_N_per_mm\n";
  for (std::size_t i = 0; i < published_groups().size(); ++i) {
    RandomStream random(seed, i);
    table += group_rows(published_groups()[i], random);
  }
  return table;
}

}  // namespace strandlab::bondline
