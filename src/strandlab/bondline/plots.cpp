#include "strandlab/bondline/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace strandlab::bondline {
namespace {

// Text inside a double-quoted gnuplot string of a terminal with enhanced text switched off.
std::string escaped(const std::string& text) {
  std::string result;
  for (char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

// The same for the label of a tick, which gnuplot takes for a number's format: "PF 25 %" has no letter behind its %.
std::string tick_label(const std::string& text) {
  std::string result;
  for (char c : escaped(text)) result += c == '%' ? "%%" : std::string(1, c);
  return result;
}

std::string file_name(const std::string& group) {
  std::string name;
  for (char c : group) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.';
    name += plain ? c : '_';
  }
  return "mapping_" + name + ".png";
}

std::vector<const Evaluated*> included(const Analysis& analysis, const Group& group) {
  std::vector<const Evaluated*> members;
  for (const auto& specimen : analysis.specimens)
    if (specimen.group == group.name && specimen.compliance_t) members.push_back(&specimen);
  return members;
}

const std::string kHeader =
    "set encoding utf8\nset terminal pngcairo noenhanced size 1200,800 font \"sans,18\"\nset grid lt 1 lc rgb "
    "\"#e0e0e0\"\n";

// Curve of the mean specimen from its lower bound to past the largest value, as gnuplot rows.
std::string curve_rows(const Geometry& mean, double last, Formula formula) {
  constexpr int kPoints = 200;
  const double bound = lower_bound_mm_per_MPa(mean);
  std::string rows;
  for (int i = 0; i <= kPoints; ++i) {
    const double part = (i + 0.01) / kPoints, compliance = bound + (last - bound) * part * part;  // steep at the bound
    rows += fmt::format("{:.8g} {:.8g}\n", compliance, stiffness_N_per_mm(mean, compliance, formula));
  }
  return rows;
}

std::string mapping_script(const Analysis& analysis, const Group& group) {
  const auto members = included(analysis, group);
  std::string points;
  double last = 0;
  for (const Evaluated* s : members) {
    const double k = *s->specimen.k_N_per_mm, factor = std::exp(kNormal975 * s->uncertainty.k_equivalent);
    points += fmt::format("{:.8g} {:.8g} {:.8g} {:.8g} {:.8g} {:.8g}\n", *s->compliance_t, k,
                          s->uncertainty.low_mm_per_MPa, s->uncertainty.high_mm_per_MPa, k / factor, k * factor);
    last = std::max(last, s->uncertainty.high_mm_per_MPa);
  }
  const double bound = lower_bound_mm_per_MPa(group.mean_geometry);
  last = std::max(1.1 * last, -bound);
  return kHeader +
         fmt::format(
             "$curve << EOD\n{}EOD\n$points << EOD\n{}EOD\n"
             "set title \"{}: stiffness of specimens mapped on the curve of the mean specimen\"\n"
             "set xlabel \"1/D_t (mm/MPa)\"\nset ylabel \"k (N/mm)\"\nset yrange [0:*]\n"
             "plot $curve with lines lw 2 title \"mean specimen\", $points using 1:2:3:4:5:6 with xyerrorbars "
             "pt 7 ps 0.7 title \"specimens, 95 % intervals\"\n",
             curve_rows(group.mean_geometry, last, analysis.options.formula), points, escaped(group.name));
}

std::string means_script(const Analysis& analysis) {
  std::string means, values, ticks;
  for (std::size_t i = 0; i < analysis.groups.size(); ++i) {
    const Group& group = analysis.groups[i];
    const auto members = included(analysis, group);
    const statistics::Summary& s = group.compliance_t;
    ticks += fmt::format("{}\"{}\" {}", ticks.empty() ? "" : ", ", tick_label(group.name), i);
    if (s.n >= 2) means += fmt::format("{} {:.8g} {:.8g} {:.8g}\n", i, s.mean, s.low, s.high);
    for (std::size_t j = 0; j < members.size(); ++j) {
      const double spread = 0.3 * (static_cast<double>(j) + 0.5) / static_cast<double>(members.size()) - 0.15;
      values += fmt::format("{:.4f} {:.8g}\n", static_cast<double>(i) + spread, *members[j]->compliance_t);
    }
  }
  std::string plot = "plot $values with points pt 6 ps 0.5 lc rgb \"gray50\" title \"specimens\"";
  if (!means.empty()) plot += ", $means with yerrorbars pt 7 lw 2 title \"mean, 95 % t-interval\"";
  return kHeader +
         fmt::format(
             "$means << EOD\n{}EOD\n$values << EOD\n{}EOD\nset xtics rotate by -45 ({})\nset xrange [-0.5:{}]\n"
             "set ylabel \"1/D_t (mm/MPa)\"\nset xzeroaxis lt -1\n{}\n",
             means, values, ticks, static_cast<double>(analysis.groups.size()) - 0.5, plot);
}

}  // namespace

std::vector<Picture> pictures(const Analysis& analysis) {
  std::vector<Picture> result;
  for (const auto& group : analysis.groups)
    if (group.compliance_t.n > 0) result.push_back({file_name(group.name), mapping_script(analysis, group)});
  if (!result.empty()) result.push_back({"means.png", means_script(analysis)});
  return result;
}

}  // namespace strandlab::bondline
