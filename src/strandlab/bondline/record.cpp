#include "strandlab/bondline/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/table/table.hpp"

namespace strandlab::bondline {
namespace {

using Points = std::vector<LoadPoint>;

constexpr int kFewestPoints = 10;
constexpr double kHuber = 1.345;           // 95 % efficiency for normal errors. Huber (1981)
constexpr double kMadToSigma = 1.4826022;  // median absolute deviation of a normal distribution
constexpr double kToeSoftening = 0.05;     // lower third of the window against the rest
constexpr double kSlipOfWindow = 0.02;     // displacement jump over the displacement of the window
constexpr double kSlipLoadDrop = 0.02;     // load drop over the largest load

struct Line {
  double intercept_mm = 0, compliance = 0, compliance_error = 0;  // displacement = intercept + compliance load
  double displacement(double load) const { return intercept_mm + compliance * load; }
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double residual(const Line& line, const LoadPoint& point) {
  return point.displacement_mm - line.displacement(point.load_N);
}

// Median slope over pairs half the window apart. Theil (1950), incomplete method.
Line theil_line(Points points) {
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.load_N < b.load_N; });
  const std::size_t half = points.size() / 2;
  std::vector<double> slopes, offsets;
  for (std::size_t i = 0; i + half < points.size(); ++i) {
    const double rise = points[i + half].load_N - points[i].load_N;
    if (rise > 0) slopes.push_back((points[i + half].displacement_mm - points[i].displacement_mm) / rise);
  }
  Line line;
  line.compliance = slopes.empty() ? 0 : median(slopes);
  for (const auto& point : points) offsets.push_back(point.displacement_mm - line.compliance * point.load_N);
  line.intercept_mm = median(offsets);
  return line;
}

// One weighted least-squares line and the weighted sum of squares of the load.
struct Weighted {
  Line line;
  double load_squares = 0;
};
Weighted weighted_line(const Points& points, const std::vector<double>& weights) {
  double sum = 0, load = 0, displacement = 0, products = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += weights[i];
    load += weights[i] * points[i].load_N;
    displacement += weights[i] * points[i].displacement_mm;
  }
  load /= sum;
  displacement /= sum;
  Weighted result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double offset = points[i].load_N - load;
    result.load_squares += weights[i] * offset * offset;
    products += weights[i] * offset * (points[i].displacement_mm - displacement);
  }
  result.line.compliance = products / result.load_squares;
  result.line.intercept_mm = displacement - result.line.compliance * load;
  return result;
}

double robust_scale(const Points& points, const Line& line) {
  std::vector<double> sizes;
  for (const auto& point : points) sizes.push_back(std::abs(residual(line, point)));
  return kMadToSigma * median(sizes);
}

// Asymptotic standard error of an M-estimator's slope. Huber (1981), section 7.6.
double slope_error(const Points& points, const Line& line, double clip) {
  const std::vector<double> ones(points.size(), 1.0);
  const auto n = static_cast<double>(points.size());
  double squares = 0, inside = 0;
  for (const auto& point : points) {
    const double size = std::abs(residual(line, point));
    squares += std::pow(std::min(size, clip), 2);
    inside += size <= clip ? 1 : 0;
  }
  return std::sqrt(squares / (n - 2) / weighted_line(points, ones).load_squares) / (inside / n);
}

Line huber_line(const Points& points) {
  Line line = theil_line(points);
  double clip = 0;
  for (int iteration = 0; iteration < 100; ++iteration) {
    clip = kHuber * robust_scale(points, line);
    if (!(clip > 0)) return line;  // the points lie on the line
    std::vector<double> weights;
    for (const auto& point : points) weights.push_back(std::min(1.0, clip / std::abs(residual(line, point))));
    const Line next = weighted_line(points, weights).line;
    const bool settled = std::abs(next.compliance - line.compliance) <= 1e-12 * std::abs(next.compliance);
    line = next;
    if (settled) break;
  }
  line.compliance_error = slope_error(points, line, clip);
  return line;
}

double r_squared(const Points& points, const Line& line) {
  double mean = 0, total = 0, left = 0;
  for (const auto& point : points) mean += point.displacement_mm / static_cast<double>(points.size());
  for (const auto& point : points) {
    total += std::pow(point.displacement_mm - mean, 2);
    left += std::pow(residual(line, point), 2);
  }
  return total > 0 ? 1 - left / total : 0;
}

void flag_toe(const Points& window, Slope& slope) {
  Points lower, upper;
  const double border = slope.low_N + (slope.high_N - slope.low_N) / 3;
  for (const auto& point : window) (point.load_N < border ? lower : upper).push_back(point);
  if (lower.size() < kFewestPoints || upper.size() < kFewestPoints) return;
  const Line low = huber_line(lower), high = huber_line(upper);
  const double more = low.compliance - high.compliance;
  if (more > kToeSoftening * high.compliance && more > 3 * std::hypot(low.compliance_error, high.compliance_error))
    slope.flags.push_back(fmt::format("toe: the lower third of the window is {:.0f} % softer than the rest",
                                      100 * more / low.compliance));
}

void flag_slip(const Points& branch, const Points& window, const Line& line, double largest_load, Slope& slope) {
  double reached = 0;
  for (const auto& point : branch) {
    if (reached - point.load_N > kSlipLoadDrop * largest_load) {
      slope.flags.push_back(fmt::format("slip: the load drops at {:.4g} N", reached));
      return;
    }
    reached = std::max(reached, point.load_N);
  }
  std::vector<double> jumps, sizes;
  for (std::size_t i = 1; i < window.size(); ++i) {
    jumps.push_back(residual(line, window[i]) - residual(line, window[i - 1]));
    sizes.push_back(std::abs(jumps.back()));
  }
  const double allowed =
      std::max(8 * kMadToSigma * median(sizes), kSlipOfWindow * line.compliance * (slope.high_N - slope.low_N));
  for (std::size_t i = 0; i < jumps.size(); ++i) {
    if (jumps[i] <= allowed) continue;
    slope.flags.push_back(
        fmt::format("slip: the displacement jumps by {:.2g} mm at {:.4g} N", jumps[i], window[i].load_N));
    return;
  }
}

}  // namespace

std::vector<LoadPoint> read_record(const std::filesystem::path& file) {
  using table::Dimension;
  const table::Table rows(file, {{{"load", "force", "standard force"}, Dimension::kForce, "N"},
                                 {{"displacement", "extension", "elongation"}, Dimension::kLength, "mm"}});
  std::vector<LoadPoint> record;
  for (int row = 0; row < rows.rows(); ++row) {
    const auto load = rows.number(row, "load"), displacement = rows.number(row, "displacement");
    if (load && displacement) record.push_back({*load, *displacement});
  }
  return record;
}

void validate(const LoadWindow& window) {
  if (!(window.low >= 0) || !(window.high > window.low) || (window.of_maximum && window.high > 1))
    throw InputError(window.of_maximum
                         ? fmt::format("load window {:g} to {:g} % of the largest load: need 0 <= low < high <= 100",
                                       100 * window.low, 100 * window.high)
                         : fmt::format("load window {:g} to {:g} N: need 0 <= low < high", window.low, window.high));
}

Slope fit_stiffness(const std::vector<LoadPoint>& record, const LoadWindow& window) {
  validate(window);
  Slope slope;
  const auto peak =
      std::max_element(record.begin(), record.end(), [](const auto& a, const auto& b) { return a.load_N < b.load_N; });
  if (peak == record.end() || !(peak->load_N > 0)) {
    slope.problem = "the record has no load above zero";
    return slope;
  }
  const double unit = window.of_maximum ? peak->load_N : 1;
  slope.low_N = window.low * unit;
  slope.high_N = window.high * unit;
  if (peak->load_N < slope.high_N) {
    slope.problem = fmt::format("the load reaches {:.4g} N, the window {:.4g} N", peak->load_N, slope.high_N);
    return slope;
  }
  const auto end = std::find_if(record.begin(), peak, [&](const auto& p) { return p.load_N > slope.high_N; });
  const Points branch(record.begin(), end);
  Points inside;
  std::copy_if(branch.begin(), branch.end(), std::back_inserter(inside),
               [&](const auto& point) { return point.load_N >= slope.low_N; });
  slope.points = static_cast<int>(inside.size());
  if (slope.points < kFewestPoints) {
    slope.problem = fmt::format("only {} points between {:.4g} and {:.4g} N; {} are needed", slope.points, slope.low_N,
                                slope.high_N, kFewestPoints);
    return slope;
  }
  const Line line = huber_line(inside);
  if (!(line.compliance > 0) || !std::isfinite(line.compliance)) {
    slope.problem = "the displacement does not grow with the load";
    return slope;
  }
  slope.stiffness_N_per_mm = 1 / line.compliance;
  slope.standard_error = line.compliance_error / line.compliance / line.compliance;
  slope.r_squared = r_squared(inside, line);
  slope.toe_mm = line.displacement(record.front().load_N) - record.front().displacement_mm;
  flag_toe(inside, slope);
  flag_slip(branch, inside, line, peak->load_N, slope);
  return slope;
}

}  // namespace strandlab::bondline
