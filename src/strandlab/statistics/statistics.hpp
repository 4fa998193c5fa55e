// Statistics of groups of measurements: t-intervals, t-tests, one-way analysis of variance, pairs.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace strandlab::statistics {

// What a group says on its own. Quantities that need two values (or a spread) are NaN where there is none.
struct Summary {
  int n = 0;
  double mean = 0, sd = 0;   // unit of the data; sd with n - 1
  double low = 0, high = 0;  // 95 % t-interval of the mean
  double t = 0, p = 0;       // one-sample t-test of mean = 0, two-sided
};
Summary summarise(const std::vector<double>& values);
// Half a 95 % interval over the standard error of its mean: the .975 quantile of Student's t.
double t_975(double degrees_of_freedom);

// Slopes of y on the columns of x by least squares, both given as deviations from the means of `groups` groups of rows,
// each of which has a level of its own; n is the number of rows, sd the standard error of a slope, the interval and the
// test of slope = 0 those of Student's t with n - groups - columns degrees of freedom (NaN where there are none). Empty
// where the columns do not determine the slopes.
std::vector<Summary> slopes(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, int groups);

// One-way analysis of variance, equal variances assumed (Fisher).
struct Anova {
  int df_between = 0, df_within = 0;
  double ss_between = 0, ss_within = 0;  // sums of squares, unit of the data squared
  double F = 0, p = 0;                   // p: probability of F or more if all means are equal
};
// Throws InputError unless there are two groups, each with a value, and more values than groups.
Anova anova(const std::vector<std::vector<double>>& groups);

// The same question without assuming equal variances. Welch, Biometrika 38 (1951) 330.
struct WelchAnova {
  double df_between = 0, df_within = 0;
  double F = 0, p = 0;
};
// Throws InputError unless there are two groups, each with two values that differ.
WelchAnova welch_anova(const std::vector<std::vector<double>>& groups);

// Difference between two groups by Welch's t-test, its p corrected for the number of pairs by Holm's step-down method
// (Scand. J. Statist. 6 (1979) 65).
struct Pair {
  int first = 0, second = 0;    // indices of the groups
  double difference = 0;        // mean of first - mean of second
  double low = 0, high = 0;     // 95 % interval of the difference, not corrected for the number of pairs
  double t = 0, df = 0, p = 0;  // two-sided
  double p_holm = 0;
};
// All pairs, in order of the groups. Same demands as welch_anova().
std::vector<Pair> holm_welch_pairs(const std::vector<std::vector<double>>& groups);

}  // namespace strandlab::statistics
