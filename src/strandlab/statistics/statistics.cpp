#include "strandlab/statistics/statistics.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "strandlab/core/error.hpp"

namespace strandlab::statistics {
namespace {

// Double precision all the way: without promotion to long double there is half as much to compile.
using Precision = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
using StudentsT = boost::math::students_t_distribution<double, Precision>;
using FisherF = boost::math::fisher_f_distribution<double, Precision>;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Sum of squared deviations from the mean: two passes, so that data with constant leading digits lose none.
double squared_deviations(const std::vector<double>& values, double mean) {
  double sum = 0;
  for (double value : values) sum += (value - mean) * (value - mean);
  return sum;
}

double two_sided_p(double t, double df) {
  if (!std::isfinite(t)) return std::isnan(t) ? kNaN : 0;
  return 2 * boost::math::cdf(boost::math::complement(StudentsT(df), std::abs(t)));
}

double upper_tail(double F, double df1, double df2) {
  if (!std::isfinite(F)) return std::isnan(F) ? kNaN : 0;
  return boost::math::cdf(boost::math::complement(FisherF(df1, df2), F));
}

// Means, variances of the mean and sizes of groups fit for Welch's tests.
struct Moments {
  double n = 0, mean = 0, variance_of_mean = 0;
};
std::vector<Moments> moments(const std::vector<std::vector<double>>& groups) {
  if (groups.size() < 2) throw InputError("a comparison needs at least two groups");
  std::vector<Moments> result;
  for (const auto& group : groups) {
    const auto n = static_cast<double>(group.size());
    const double mean = group.empty() ? 0 : mean_of(group);
    const double squares = squared_deviations(group, mean);
    if (n < 2 || !(squares > 0)) throw InputError("Welch's test needs two different values in every group");
    result.push_back({n, mean, squares / (n - 1) / n});
  }
  return result;
}

}  // namespace

double t_975(double df) {
  return boost::math::quantile(StudentsT(df), 0.975);
}

Summary summarise(const std::vector<double>& values) {
  Summary s{static_cast<int>(values.size()), kNaN, kNaN, kNaN, kNaN, kNaN, kNaN};
  if (s.n == 0) return s;
  s.mean = mean_of(values);
  if (s.n == 1) return s;
  const double df = s.n - 1;
  s.sd = std::sqrt(squared_deviations(values, s.mean) / df);
  const double error = s.sd / std::sqrt(s.n);
  s.low = s.mean - t_975(df) * error;
  s.high = s.mean + t_975(df) * error;
  if (!(error > 0)) return s;
  s.t = s.mean / error;
  s.p = two_sided_p(s.t, df);
  return s;
}

std::vector<Summary> slopes(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, int groups) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(x);
  if (qr.rank() < x.cols()) return {};
  const Eigen::VectorXd slope = qr.solve(y);
  const double df = static_cast<double>(x.rows() - x.cols()) - groups;
  const double variance = df > 0 ? (y - x * slope).squaredNorm() / df : kNaN;
  const Eigen::MatrixXd covariance = (x.transpose() * x).inverse() * variance;
  std::vector<Summary> result;
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    Summary s{static_cast<int>(x.rows()), slope[k], kNaN, kNaN, kNaN, kNaN, kNaN};
    if (df > 0) {
      s.sd = std::sqrt(covariance(k, k));
      s.low = s.mean - t_975(df) * s.sd;
      s.high = s.mean + t_975(df) * s.sd;
      if (s.sd > 0) {
        s.t = s.mean / s.sd;
        s.p = two_sided_p(s.t, df);
      }
    }
    result.push_back(s);
  }
  return result;
}

Anova anova(const std::vector<std::vector<double>>& groups) {
  std::vector<double> all;
  for (const auto& group : groups) {
    if (group.empty()) throw InputError("analysis of variance: a group without values");
    all.insert(all.end(), group.begin(), group.end());
  }
  if (groups.size() < 2) throw InputError("analysis of variance needs at least two groups");
  if (all.size() <= groups.size()) throw InputError("analysis of variance needs more values than groups");
  Anova result;
  const double grand = mean_of(all);
  for (const auto& group : groups) {
    const double mean = mean_of(group);
    result.ss_between += static_cast<double>(group.size()) * (mean - grand) * (mean - grand);
    result.ss_within += squared_deviations(group, mean);
  }
  result.df_between = static_cast<int>(groups.size()) - 1;
  result.df_within = static_cast<int>(all.size() - groups.size());
  result.F = (result.ss_between / result.df_between) / (result.ss_within / result.df_within);
  result.p = upper_tail(result.F, result.df_between, result.df_within);
  return result;
}

WelchAnova welch_anova(const std::vector<std::vector<double>>& groups) {
  const auto all = moments(groups);
  const auto count = static_cast<double>(all.size());
  double weights = 0, weighted = 0;
  for (const auto& m : all) {
    weights += 1 / m.variance_of_mean;
    weighted += m.mean / m.variance_of_mean;
  }
  const double grand = weighted / weights;
  double between = 0, lambda = 0;
  for (const auto& m : all) {
    const double weight = 1 / m.variance_of_mean;
    between += weight * (m.mean - grand) * (m.mean - grand) / (count - 1);
    lambda += (1 - weight / weights) * (1 - weight / weights) / (m.n - 1);
  }
  WelchAnova result;
  result.df_between = count - 1;
  result.df_within = (count * count - 1) / (3 * lambda);
  result.F = between / (1 + 2 * (count - 2) / (count * count - 1) * lambda);
  result.p = upper_tail(result.F, result.df_between, result.df_within);
  return result;
}

std::vector<Pair> holm_welch_pairs(const std::vector<std::vector<double>>& groups) {
  const auto all = moments(groups);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const double va = all[i].variance_of_mean, vb = all[j].variance_of_mean;
      Pair pair;
      pair.first = static_cast<int>(i);
      pair.second = static_cast<int>(j);
      pair.difference = all[i].mean - all[j].mean;
      pair.t = pair.difference / std::sqrt(va + vb);
      pair.df = (va + vb) * (va + vb) / (va * va / (all[i].n - 1) + vb * vb / (all[j].n - 1));
      pair.p = two_sided_p(pair.t, pair.df);
      const double half = t_975(pair.df) * std::sqrt(va + vb);
      pair.low = pair.difference - half;
      pair.high = pair.difference + half;
      pairs.push_back(pair);
    }
  }
  std::vector<Pair*> by_p;
  by_p.reserve(pairs.size());
  for (auto& pair : pairs) by_p.push_back(&pair);
  std::stable_sort(by_p.begin(), by_p.end(), [](const Pair* a, const Pair* b) { return a->p < b->p; });
  double floor = 0;
  for (std::size_t rank = 0; rank < by_p.size(); ++rank) {
    floor = std::max(floor, static_cast<double>(by_p.size() - rank) * by_p[rank]->p);
    by_p[rank]->p_holm = std::min(1.0, floor);
  }
  return pairs;
}

}  // namespace strandlab::statistics
