#include "strandlab/bondline/shear_lag.hpp"

#include <fmt/format.h>

#include <array>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <utility>

#include "strandlab/core/error.hpp"

namespace strandlab::bondline {
namespace {

double square(double x) {
  return x * x;
}

// Shear compliance of the strands themselves between their mid planes, mm/MPa.
double strand_shear_compliance(const Geometry& g) {
  return g.t1_mm / (3 * g.shear1_MPa()) + g.t2_mm / (6 * g.shear2_MPa());
}

// k of a given C/C_inf: the glued length in series with the tabs.
double stiffness_of_ratio(const Geometry& g, double ratio) {
  const double lambda = g.t1_mm / g.t2_mm, R = g.E1_MPa / g.E2_MPa;
  return g.t2_mm * g.E2_MPa * g.W_mm / (ratio * g.l_mm / (1 + 2 * R * lambda) + g.L1_mm / (2 * lambda * R) + g.L2_mm);
}

// d ln k / d S with S the total shear compliance 1/D_t + strands; central difference, step 1e-5 S (error ~1e-10).
double log_slope(const Geometry& g, double compliance, Formula formula) {
  const double step = 1e-5 * (compliance + strand_shear_compliance(g));
  return std::log(stiffness_N_per_mm(g, compliance + step, formula) /
                  stiffness_N_per_mm(g, compliance - step, formula)) /
         (2 * step);
}

// Effect of the relative change of one input on ln k at fixed 1/D_t, times its relative uncertainty.
double contribution(const Geometry& g, double compliance, Formula formula, double Geometry::*input, double relative) {
  constexpr double step = 1e-5;
  Geometry up = g, down = g;
  up.*input *= 1 + step;
  down.*input *= 1 - step;
  return relative *
         std::log(stiffness_N_per_mm(up, compliance, formula) / stiffness_N_per_mm(down, compliance, formula)) /
         (2 * step);
}

// What is wrong with a value that must be positive, empty when nothing is.
std::string positive_fault(const char* name, double value) {
  return value > 0 && std::isfinite(value) ? "" : fmt::format("{} = {:g} must be positive", name, value);
}

}  // namespace

const char* name(Formula formula) {
  return formula == Formula::kCoth ? "coth" : "le2010";
}

Formula formula_from_name(const std::string& text) {
  for (Formula formula : {Formula::kCoth, Formula::kLe2010})
    if (text == name(formula)) return formula;
  throw InputError(fmt::format("formula '{}' is not known; allowed: coth, le2010", text));
}

std::string fault(const Geometry& g) {
  using Named = std::pair<const char*, double>;
  for (const auto& [label, value] :
       {Named{"E1_MPa", g.E1_MPa}, Named{"E2_MPa", g.E2_MPa}, Named{"t1_mm", g.t1_mm}, Named{"t2_mm", g.t2_mm},
        Named{"W_mm", g.W_mm}, Named{"l_mm", g.l_mm}, Named{"G1_MPa", g.shear1_MPa()}, Named{"G2_MPa", g.shear2_MPa()}})
    if (auto message = positive_fault(label, value); !message.empty()) return message;
  for (const auto& [label, value] : {Named{"L1_mm", g.L1_mm}, Named{"L2_mm", g.L2_mm}})
    if (!(value >= 0) || !std::isfinite(value)) return fmt::format("{} = {:g} must not be negative", label, value);
  return "";
}

double compliance_ratio(const Geometry& g, double compliance, Formula formula) {
  const double lambda = g.t1_mm / g.t2_mm, R = g.E1_MPa / g.E2_MPa;
  const double a = 1 + 2 * R * lambda, b = 1 - 2 * R * lambda;
  const double S = compliance + strand_shear_compliance(g);
  const double beta = std::sqrt((1 / (g.t1_mm * g.E1_MPa) + 2 / (g.t2_mm * g.E2_MPa)) / S);
  const double y = beta * g.l_mm / 2, scale = 4 * g.l_mm * R * beta * lambda;
  if (formula == Formula::kCoth) return 1 + (square(b) * std::tanh(y) + square(a) / std::tanh(y)) / scale;
  // coth y = tanh(y/2) + csch y; the printed csch term has 1/D_t where S belongs.
  const double csch = y < 700 ? 1 / std::sinh(y) : 0;
  return 1 + (square(b) * std::tanh(y) + square(a) * std::tanh(y / 2)) / scale +
         compliance * g.E2_MPa * g.t2_mm * square(beta) * a / (4 * g.l_mm * beta) * csch;
}

double stiffness_N_per_mm(const Geometry& g, double compliance, Formula formula) {
  return stiffness_of_ratio(g, compliance_ratio(g, compliance, formula));
}

double rigid_limit_N_per_mm(const Geometry& g) {
  return stiffness_of_ratio(g, 1);
}

double lower_bound_mm_per_MPa(const Geometry& g) {
  return -strand_shear_compliance(g);
}

double sensitivity(const Geometry& g, double compliance, Formula formula) {
  return compliance * log_slope(g, compliance, formula);
}

GlueCompliance glue_compliance(const Geometry& g, double k, Formula formula) {
  if (!std::isfinite(k)) return {{}, "stiffness is not a number"};
  if (k <= 0) return {{}, fmt::format("stiffness {:g} N/mm is not above zero", k)};
  const double limit = rigid_limit_N_per_mm(g);
  if (k >= limit) return {{}, fmt::format("stiffness {:.6g} N/mm is above the rigid-bond limit {:.6g} N/mm", k, limit)};
  const double strands = strand_shear_compliance(g);
  // ln k falls monotonically with ln S, S = 1/D_t + strands > 0.
  const auto excess = [&](double log_S) {
    return std::log(stiffness_N_per_mm(g, std::exp(log_S) - strands, formula) / k);
  };
  double low = std::log(strands), high = low;
  constexpr double kDecade = 2.302585092994046, kSmallest = -200;
  while (excess(low) < 0 && low > kSmallest) low -= kDecade;
  while (excess(high) > 0 && high < -kSmallest) high += kDecade;
  if (excess(low) < 0 || excess(high) > 0)
    return {{}, fmt::format("stiffness {:.6g} N/mm cannot be told from the rigid-bond limit {:.6g} N/mm", k, limit)};
  std::uintmax_t iterations = 200;
  const auto root = boost::math::tools::toms748_solve(excess, low, std::nextafter(high, 1e9),
                                                      boost::math::tools::eps_tolerance<double>(50), iterations);
  return {std::exp((root.first + root.second) / 2) - strands, ""};
}

Propagated propagate(const Geometry& g, double compliance, const Uncertainty& u, Formula formula) {
  const std::array<double, 5> parts{contribution(g, compliance, formula, &Geometry::E1_MPa, u.E_relative),
                                    contribution(g, compliance, formula, &Geometry::E2_MPa, u.E_relative),
                                    contribution(g, compliance, formula, &Geometry::t1_mm, u.t_relative),
                                    contribution(g, compliance, formula, &Geometry::t2_mm, u.t_relative),
                                    contribution(g, compliance, formula, &Geometry::l_mm, u.l_mm / g.l_mm)};
  double sum = square(u.k_relative);
  for (double part : parts) sum += square(part);
  Propagated result;
  result.k_equivalent = std::sqrt(sum);
  result.standard_mm_per_MPa = result.k_equivalent / std::abs(log_slope(g, compliance, formula));
  const double k = stiffness_N_per_mm(g, compliance, formula), factor = std::exp(kNormal975 * result.k_equivalent);
  result.low_mm_per_MPa = glue_compliance(g, k * factor, formula).value_mm_per_MPa.value_or(lower_bound_mm_per_MPa(g));
  result.high_mm_per_MPa = glue_compliance(g, k / factor, formula).value_mm_per_MPa.value_or(compliance);
  return result;
}

Design best_overlap(const Geometry& g, double compliance, const Uncertainty& u, double shortest, double longest,
                    Formula formula) {
  if (!(shortest > 0) || !(longest > shortest) || !std::isfinite(longest))
    throw InputError(fmt::format("overlaps from {:g} to {:g} mm: need 0 < shortest < longest", shortest, longest));
  if (!(compliance > 0) || !std::isfinite(compliance))
    throw InputError(fmt::format("design needs a glue compliance 1/D_t above zero, given {:g} mm/MPa", compliance));
  const auto with_overlap = [&](double log_l) {
    Geometry changed = g;
    changed.l_mm = std::exp(log_l);
    return changed;
  };
  const auto error = [&](double log_l) {
    return propagate(with_overlap(log_l), compliance, u, formula).standard_mm_per_MPa / compliance;
  };
  const double first = std::log(shortest), last = std::log(longest);
  // Sampled first: the minimum may sit at either end of the range.
  constexpr int kSamples = 200;
  const auto sample = [&](int i) { return first + (last - first) * i / kSamples; };
  int best = 0;
  for (int i = 1; i <= kSamples; ++i)
    if (error(sample(i)) < error(sample(best))) best = i;
  const auto [at, least] = boost::math::tools::brent_find_minima(error, sample(best > 0 ? best - 1 : 0),
                                                                 sample(best < kSamples ? best + 1 : kSamples), 30);
  Design design;
  design.overlap_mm = std::exp(at);
  design.relative_uncertainty = least;
  int low = best, high = best;
  while (low > 0 && error(sample(low - 1)) <= 1.1 * least) --low;
  while (high < kSamples && error(sample(high + 1)) <= 1.1 * least) ++high;
  design.shortest_mm = std::exp(sample(low));
  design.longest_mm = std::exp(sample(high));
  design.sensitivity = bondline::sensitivity(with_overlap(at), compliance, formula);
  design.stiffness_N_per_mm = bondline::stiffness_N_per_mm(with_overlap(at), compliance, formula);
  return design;
}

}  // namespace strandlab::bondline
