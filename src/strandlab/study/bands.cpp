#include "strandlab/study/bands.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>

#include "strandlab/files/text_file.hpp"
#include "strandlab/statistics/statistics.hpp"

namespace strandlab::study {
namespace {

double at(const Curve& curve, double x) {
  const auto above = std::lower_bound(curve.x.begin(), curve.x.end(), x);
  if (above == curve.x.begin()) return curve.y.front();
  if (above == curve.x.end()) return curve.y.back();
  const auto i = static_cast<std::size_t>(above - curve.x.begin());
  const double part = (x - curve.x[i - 1]) / (curve.x[i] - curve.x[i - 1]);
  return curve.y[i - 1] + part * (curve.y[i] - curve.y[i - 1]);
}

std::vector<std::string_view> cells_of_line(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t from = 0; from <= line.size();) {
    const auto comma = std::min(line.find(',', from), line.size());
    cells.push_back(line.substr(from, comma - from));
    from = comma + 1;
  }
  return cells;
}

// Columns of a table that a pressing wrote; nothing where it has none of this name.
std::optional<std::vector<std::vector<double>>> columns(const std::filesystem::path& file,
                                                        const std::vector<std::string>& names) {
  const auto text = files::read_text(file);
  if (!text) return std::nullopt;
  std::istringstream lines(*text);
  std::string line;
  std::getline(lines, line);
  const auto head = cells_of_line(line);
  std::vector<std::size_t> places;
  for (const auto& name : names) {
    const auto found = std::find(head.begin(), head.end(), name);
    if (found == head.end()) return std::nullopt;
    places.push_back(static_cast<std::size_t>(found - head.begin()));
  }
  std::vector<std::vector<double>> result(names.size());
  while (std::getline(lines, line)) {
    const auto cells = cells_of_line(line);
    for (std::size_t i = 0; i < places.size(); ++i) {
      double value = std::nan("");
      if (places[i] < cells.size()) {
        const auto cell = cells[places[i]];
        std::from_chars(cell.data(), cell.data() + cell.size(), value);
      }
      result[i].push_back(value);
    }
  }
  return result;
}

using ByCell = std::map<std::size_t, std::vector<const Item*>>;

ByCell by_cell(const Study& study, const std::vector<const Item*>& whole) {
  const auto cells = cells_of(study.plan).size();
  ByCell result;
  for (const auto* item : whole) result[static_cast<std::size_t>(item->number - 1) % cells].push_back(item);
  return result;
}

Curve stress_curve(const std::vector<std::vector<double>>& table) {
  Curve curve;
  for (std::size_t i = 0; i < table[0].size(); ++i) {
    if (!curve.x.empty() && !(table[0][i] > curve.x.back())) continue;  // a press that opens again
    curve.x.push_back(table[0][i]);
    curve.y.push_back(table[1][i]);
  }
  return curve;
}

// The profile of each state in turn.
std::vector<Curve> profile_curves(const std::vector<std::vector<double>>& table) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < table[0].size(); ++i) {
    if (i == 0 || table[0][i] != table[0][i - 1]) curves.emplace_back();
    curves.back().x.push_back(table[1][i]);
    curves.back().y.push_back(table[2][i]);
  }
  return curves;
}

}  // namespace

Band band_of(const std::vector<Curve>& curves, const std::vector<double>& x) {
  Band band{x, {}, {}, {}, static_cast<int>(curves.size())};
  for (const double place : x) {
    std::vector<double> values;
    values.reserve(curves.size());
    for (const auto& curve : curves) values.push_back(at(curve, place));
    const auto s = statistics::summarise(values);
    band.mean.push_back(s.mean);
    band.low.push_back(s.low);
    band.high.push_back(s.high);
  }
  return band;
}

files::CsvTable stress_bands(const Study& study, const std::vector<const Item*>& whole) {
  constexpr int kSteps = 100;
  files::CsvTable table({"cell", "n", "compaction", "stress_MPa", "low_MPa", "high_MPa"});
  for (const auto& [cell, items] : by_cell(study, whole)) {
    std::vector<Curve> curves;
    for (const auto* item : items) {
      const auto read = columns(study.pressing_folder(*item) / "press.csv", {"compaction", "stress_MPa"});
      if (read && !read->front().empty()) curves.push_back(stress_curve(*read));
    }
    if (curves.empty()) continue;
    double end = curves.front().x.back();
    for (const auto& curve : curves) end = std::min(end, curve.x.back());
    std::vector<double> grid;
    for (int i = 0; i <= kSteps; ++i) grid.push_back(end * i / kSteps);
    const auto band = band_of(curves, grid);
    for (std::size_t i = 0; i < grid.size(); ++i)
      table.add_row({static_cast<long long>(cell), static_cast<long long>(band.n), grid[i], band.mean[i], band.low[i],
                     band.high[i]});
  }
  return table;
}

files::CsvTable profile_bands(const Study& study, const std::vector<const Item*>& whole) {
  files::CsvTable table({"cell", "state", "n", "relative_height", "density_kg_m3", "low_kg_m3", "high_kg_m3"});
  for (const auto& [cell, items] : by_cell(study, whole)) {
    std::vector<std::vector<Curve>> of_states;
    for (const auto* item : items) {
      const auto read =
          columns(study.pressing_folder(*item) / "profile.csv", {"compaction", "relative_height", "density_kg_m3"});
      if (!read) continue;
      const auto curves = profile_curves(*read);
      of_states.resize(std::max(of_states.size(), curves.size()));
      for (std::size_t s = 0; s < curves.size(); ++s) of_states[s].push_back(curves[s]);
    }
    for (std::size_t s = 0; s < of_states.size(); ++s) {
      const auto& heights = of_states[s].front().x;
      const auto band = band_of(of_states[s], heights);
      for (std::size_t i = 0; i < heights.size(); ++i)
        table.add_row({static_cast<long long>(cell), static_cast<long long>(s + 1), static_cast<long long>(band.n),
                       heights[i], band.mean[i], band.low[i], band.high[i]});
    }
  }
  return table;
}

}  // namespace strandlab::study
