#include "strandlab/report/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>

namespace strandlab::report {
namespace {

std::string title_of(const std::string& test) {
  std::string title = test + " modulus";
  std::replace(title.begin(), title.end(), '_', ' ');
  title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

// Snapshots are taken at round compactions up to one time step.
double rounded_percent(double compaction) {
  return std::round(1e4 * compaction) / 100;
}
std::string compaction_percent(double compaction) {
  return fmt::format("{} %", std::abs(rounded_percent(compaction)));
}

// Points of one curve by x.
Curve curve_of(const std::string& name, const std::map<double, double>& points) {
  Curve curve{name, {}, {}};
  for (const auto& [x, y] : points) {
    curve.x.push_back(x);
    curve.y.push_back(y);
  }
  return curve;
}

// Room to the right of the last point, and to the left unless the axis starts there by nature.
void fit_axis(Plot& plot, std::optional<double> start) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& curve : plot.curves) {
    for (const double x : curve.x) {
      low = std::min(low, x);
      high = std::max(high, x);
    }
  }
  const double margin = high > low ? 0.03 * (high - low) : 0.5;
  plot.x_low = start.value_or(low - margin);
  plot.x_high = high + margin;
}

// Outline of a histogram from its first to its last bin that can be seen. gnuplot's fsteps go up, then right.
Curve outline(const Histogram& h, const std::string& name) {
  const auto holds = [](double fraction) { return fraction > 1e-3; };
  const auto first = std::find_if(h.fraction.begin(), h.fraction.end(), holds) - h.fraction.begin();
  const auto past = h.fraction.rend() - std::find_if(h.fraction.rbegin(), h.fraction.rend(), holds);
  if (past == 0) return {name, {}, {}};
  Curve curve{name, {h.edges[static_cast<std::size_t>(first)]}, {0}};
  for (auto b = static_cast<std::size_t>(first); b < static_cast<std::size_t>(past); ++b) {
    curve.x.push_back(h.edges[b + 1]);
    curve.y.push_back(100 * h.fraction[b]);
  }
  curve.x.push_back(curve.x.back());
  curve.y.push_back(0);
  return curve;
}

Plot histogram_plot(const std::vector<Morphology>& states, Histogram Morphology::*quantity, const std::string& title,
                    const std::string& x_label) {
  Plot plot{title, x_label, "share of the wood, %", "compaction", CurveStyle::kSteps, 0, 1, {}, {}};
  for (const auto& state : states) {
    const Histogram& h = state.*quantity;
    // A mat as formed is one bar that would dwarf the rest.
    if (states.size() == 1 || h.highest - h.lowest > h.edges[1] - h.edges[0]) {
      plot.curves.push_back(outline(h, compaction_percent(state.compaction)));
    }
  }
  if (plot.curves.empty() && !states.empty())  // every state is one bar
    plot.curves.push_back(outline(states.back().*quantity, compaction_percent(states.back().compaction)));
  fit_axis(plot, std::nullopt);
  return plot;
}

}  // namespace

Plot stress_plot(const std::vector<press::Record>& records) {
  Plot plot{"Pressing", "compaction, %", "stress, mean of both platens, MPa", "", CurveStyle::kLines, 0, 1, {Curve{}},
            {}};
  for (const auto& record : records) {
    plot.curves[0].x.push_back(100 * record.compaction);
    plot.curves[0].y.push_back(record.stress_MPa);
  }
  fit_axis(plot, 0.0);
  return plot;
}

Plot compliance_plot(const std::vector<PanelModulus>& moduli, const std::string& test,
                     const std::vector<Curve>& references) {
  std::map<double, std::map<double, double>> curves;
  for (const auto& m : moduli) {
    if (m.test == test) curves[rounded_percent(m.compaction)][m.compliance_t_mm_per_MPa] = m.modulus_MPa;
  }
  Plot plot{title_of(test), "1/Dₜ, mm/MPa", "modulus, MPa", "compaction", CurveStyle::kLinesAndPoints, 0, 1, {},
            references};
  for (const auto& [compaction, points] : curves)
    plot.curves.push_back(curve_of(compaction_percent(compaction / 100), points));
  fit_axis(plot, std::nullopt);
  return plot;
}

Plot compaction_plot(const std::vector<PanelModulus>& moduli, const std::string& test,
                     const std::vector<Curve>& references, const std::function<std::string(double)>& name_of_glue) {
  std::map<double, std::map<double, double>> curves;
  for (const auto& m : moduli) {
    if (m.test == test) curves[m.compliance_t_mm_per_MPa][1 / (1 - m.compaction)] = m.modulus_MPa;
  }
  Plot plot{title_of(test), "1/(1 - C)", "modulus, MPa", "glue, 1/Dₜ in mm/MPa", CurveStyle::kLinesAndPoints, 0, 1, {},
            references};
  for (const auto& [compliance_t, points] : curves) plot.curves.push_back(curve_of(name_of_glue(compliance_t), points));
  fit_axis(plot, std::nullopt);
  return plot;
}

Plot grain_angle_plot(const std::vector<Morphology>& states) {
  return histogram_plot(states, &Morphology::grain_angle, "Grain angle", "grain angle against the panel, °");
}

Plot thickness_strain_plot(const std::vector<Morphology>& states) {
  return histogram_plot(states, &Morphology::thickness_strain, "Thickness strain of the strands",
                        "thickness strain of the strands");
}

}  // namespace strandlab::report
