#include "strandlab/report/density_profiles.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

namespace strandlab::report {
namespace {

constexpr const char* kHeightLabel = "height over the bottom face, % of the thickness";
constexpr const char* kDensityLabel = "density, kg/m³";

double middle(std::size_t bin, std::size_t bins) {
  return (static_cast<double>(bin) + 0.5) / static_cast<double>(bins);
}

std::vector<files::CsvCell> bin_cells(const profile::Profile& p, std::size_t k) {
  const double height = p.bin_height_mm();
  return {p.compaction, static_cast<double>(k) * height, static_cast<double>(k + 1) * height,
          middle(k, p.density_kg_m3.size()), p.density_kg_m3[k]};
}

// Numbers of a summary by the names of their columns.
std::vector<std::pair<std::string, double>> named(const profile::Summary& s) {
  return {{"mean_kg_m3", s.mean},
          {"peak_kg_m3", s.peak},
          {"peak_depth_mm", s.peak_depth_mm},
          {"peak_bottom_kg_m3", s.peak_bottom},
          {"peak_bottom_depth_mm", s.peak_bottom_depth_mm},
          {"peak_top_kg_m3", s.peak_top},
          {"peak_top_depth_mm", s.peak_top_depth_mm},
          {"skin_kg_m3", s.skin},
          {"surface_kg_m3", s.surface},
          {"core_kg_m3", s.core},
          {"surface_over_core", s.surface_over_core()}};
}

std::vector<std::string> summary_columns(std::vector<std::string> first) {
  for (const auto& [name, value] : named({})) first.push_back(name);
  return first;
}

std::string in_percent(double compaction) {
  return fmt::format("{} %", std::abs(std::round(1e4 * compaction) / 100));
}

Curve curve_of(const profile::Profile& p, const std::string& name) {
  Curve curve{name, {}, {}};
  for (std::size_t k = 0; k < p.density_kg_m3.size(); ++k) {
    curve.x.push_back(100 * middle(k, p.density_kg_m3.size()));
    curve.y.push_back(p.density_kg_m3[k]);
  }
  return curve;
}

Band band_of(const profile::Mean& mean) {
  Band band;
  for (std::size_t k = 0; k < mean.density_kg_m3.size(); ++k) {
    const auto& bin = mean.density_kg_m3[k];
    if (!std::isfinite(bin.low)) return {};
    band.x.push_back(100 * middle(k, mean.density_kg_m3.size()));
    band.low.push_back(bin.low);
    band.high.push_back(bin.high);
  }
  return band;
}

Plot empty_plot(const std::string& title, const std::string& key_title) {
  return {title, kHeightLabel, kDensityLabel, key_title, CurveStyle::kLines, 0, 100, {}, {}};
}

profile::Profile over_mean(profile::Profile p) {
  const double mean = profile::mean_between(p, 0, 1);
  for (auto& density : p.density_kg_m3) density /= mean;
  return p;
}

}  // namespace

files::CsvTable profile_table(const std::vector<profile::Profile>& states) {
  files::CsvTable table({"compaction", "from_mm", "to_mm", "relative_height", "density_kg_m3"});
  for (const auto& p : states) {
    for (std::size_t k = 0; k < p.density_kg_m3.size(); ++k) table.add_row(bin_cells(p, k));
  }
  return table;
}

files::CsvTable profile_summary_table(const std::vector<profile::Profile>& states) {
  files::CsvTable table(summary_columns({"compaction", "thickness_mm"}));
  for (const auto& p : states) {
    std::vector<files::CsvCell> row{p.compaction, p.thickness_mm};
    for (const auto& [name, value] : named(profile::summarise(p))) row.emplace_back(value);
    table.add_row(row);
  }
  return table;
}

Plot profile_plot(const std::vector<profile::Profile>& states) {
  Plot plot = empty_plot("Density profile", "compaction");
  for (const auto& p : states) plot.curves.push_back(curve_of(p, in_percent(p.compaction)));
  return plot;
}

files::CsvTable replicate_profile_table(const std::vector<Replicate>& replicates) {
  files::CsvTable table({"replicate", "compaction", "from_mm", "to_mm", "relative_height", "density_kg_m3"});
  for (const auto& replicate : replicates) {
    for (const auto& p : replicate.states) {
      for (std::size_t k = 0; k < p.density_kg_m3.size(); ++k) {
        auto row = bin_cells(p, k);
        row.insert(row.begin(), replicate.name);
        table.add_row(row);
      }
    }
  }
  return table;
}

files::CsvTable replicate_summary_table(const std::vector<Replicate>& replicates) {
  files::CsvTable table(summary_columns({"compaction", "replicate", "thickness_mm"}));
  for (std::size_t i = 0; i < replicates.front().states.size(); ++i) {
    std::vector<std::vector<double>> values;  // by column, by replicate
    for (const auto& replicate : replicates) {
      const auto& p = replicate.states[i];
      std::vector<double> numbers{p.thickness_mm};
      for (const auto& [name, value] : named(profile::summarise(p))) numbers.push_back(value);
      values.resize(numbers.size());
      std::vector<files::CsvCell> row{p.compaction, replicate.name};
      for (std::size_t c = 0; c < numbers.size(); ++c) {
        row.emplace_back(numbers[c]);
        values[c].push_back(numbers[c]);
      }
      table.add_row(row);
    }
    using Summary = statistics::Summary;
    for (const auto& [name, member] :
         {std::pair{"mean", &Summary::mean}, std::pair{"low", &Summary::low}, std::pair{"high", &Summary::high}}) {
      if (replicates.size() < 2 && member != &Summary::mean) continue;
      std::vector<files::CsvCell> row{replicates.front().states[i].compaction, name};
      for (const auto& column : values) row.emplace_back(statistics::summarise(column).*member);
      table.add_row(row);
    }
  }
  return table;
}

files::CsvTable mean_profile_table(const std::vector<profile::Mean>& means) {
  files::CsvTable table(
      {"compaction", "relative_height", "density_kg_m3", "sd_kg_m3", "low_kg_m3", "high_kg_m3", "replicates"});
  for (const auto& mean : means) {
    for (std::size_t k = 0; k < mean.density_kg_m3.size(); ++k) {
      const auto& bin = mean.density_kg_m3[k];
      table.add_row({mean.compaction, middle(k, mean.density_kg_m3.size()), bin.mean, bin.sd, bin.low, bin.high,
                     static_cast<long long>(bin.n)});
    }
  }
  return table;
}

Plot mean_profile_plot(const std::vector<profile::Mean>& means) {
  Plot plot = empty_plot("Density profile, mean and 95 % t-interval of the replicates", "compaction");
  for (const auto& mean : means) {
    plot.curves.push_back(curve_of(mean.profile(), in_percent(mean.compaction)));
    plot.bands.push_back(band_of(mean));
  }
  return plot;
}

Plot profile_summary_plot(const std::vector<profile::Mean>& means) {
  Plot plot{
      "Density against compaction", "compaction, %", kDensityLabel, "", CurveStyle::kLinesAndPoints, 0, 1, {}, {}};
  using Summary = profile::Summary;
  constexpr std::array<std::pair<const char*, double Summary::*>, 5> kLines{
      std::pair{"peak", &Summary::peak}, std::pair{"skin", &Summary::skin}, std::pair{"surface", &Summary::surface},
      std::pair{"mean", &Summary::mean}, std::pair{"core", &Summary::core}};
  for (const auto& [name, member] : kLines) {
    Curve curve{name, {}, {}};
    for (const auto& mean : means) {
      curve.x.push_back(100 * mean.compaction);
      curve.y.push_back(profile::summarise(mean.profile()).*member);
    }
    plot.curves.push_back(curve);
  }
  plot.x_low = -1;
  plot.x_high = means.empty() ? 1 : 100 * means.back().compaction + 1;
  return plot;
}

files::CsvTable measured_table(const std::vector<profile::Specimen>& specimens) {
  files::CsvTable table({"specimen", "position_mm", "relative_height", "density_kg_m3"});
  for (const auto& s : specimens) {
    for (std::size_t i = 0; i < s.position_mm.size(); ++i)
      table.add_row({s.name, s.position_mm[i], s.position_mm[i] / s.thickness_mm(), s.density_kg_m3[i]});
  }
  return table;
}

files::CsvTable comparison_table(const std::vector<profile::Mean>& simulated, const profile::Mean& measured) {
  files::CsvTable table({"compaction", "simulated_thickness_mm", "measured_thickness_mm", "simulated_mean_kg_m3",
                         "measured_mean_kg_m3", "rms_difference_kg_m3", "rms_difference_of_shapes"});
  const auto real = measured.profile();
  for (const auto& mean : simulated) {
    const auto p = mean.profile();
    table.add_row({mean.compaction, mean.thickness_mm, measured.thickness_mm, profile::mean_between(p, 0, 1),
                   profile::mean_between(real, 0, 1), profile::rms_difference(p, real),
                   profile::rms_difference(over_mean(p), over_mean(real))});
  }
  return table;
}

Plot measured_profile_plot(const profile::Mean& simulated, const profile::Mean& measured) {
  const double rms = profile::rms_difference(simulated.profile(), measured.profile());
  Plot plot = empty_plot(fmt::format("Simulated at {} compaction, and measured: rms difference {:.0f} kg/m³",
                                     in_percent(simulated.compaction), rms),
                         "");
  const auto count = [](const profile::Mean& mean) { return mean.density_kg_m3.front().n; };
  plot.curves.push_back(curve_of(simulated.profile(), fmt::format("simulated, n = {}", count(simulated))));
  plot.curves.push_back(curve_of(measured.profile(), fmt::format("measured, n = {}", count(measured))));
  plot.bands = {band_of(simulated), band_of(measured)};
  return plot;
}

}  // namespace strandlab::report
