#include "strandlab/vtest/window.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace strandlab::vtest {
namespace {

// Mean x of each column of a strand's corner lattice, from its left end to its right one.
std::vector<double> mean_line(const Strand<2>& strand) {
  const auto lattice = corners(strand);
  const auto columns = static_cast<std::size_t>(strand.points[0]) + 1;
  std::vector<double> line(columns, 0.0);
  for (std::size_t c = 0; c < lattice.size(); ++c) line[c % columns] += lattice[c][0];
  for (double& x : line) x /= strand.points[1] + 1;
  return line;
}

// The part of a strand between the planes, in columns of its lattice.
struct Part {
  double from, to;
};

std::optional<Part> part_inside(const std::vector<double>& line, double length) {
  const auto place = [&](std::size_t i, double x) {  // between columns i and i + 1
    return static_cast<double>(i) + (x - line[i]) / (line[i + 1] - line[i]);
  };
  const auto inside = [&](double x) { return x >= 0 && x <= length; };
  const auto first = std::find_if(line.begin(), line.end(), inside);
  if (first == line.end()) return std::nullopt;
  const auto last = std::find_if(line.rbegin(), line.rend(), inside);
  const auto i = static_cast<std::size_t>(first - line.begin());
  const auto k = static_cast<std::size_t>(line.rend() - last) - 1;
  Part part{static_cast<double>(i), static_cast<double>(k)};
  if (i > 0) part.from = place(i - 1, line[i - 1] < 0 ? 0 : length);
  if (k + 1 < line.size()) part.to = place(k, line[k + 1] > length ? length : 0);
  return part;
}

// Values at the points of a row, taken at column s + 1/2 of the lattice: linear between points and beyond the last.
template <class T>
T between(const std::vector<T>& values, std::size_t row_start, int columns, double s) {
  if (columns == 1) return values[row_start];
  const int i = std::clamp(static_cast<int>(std::floor(s)), 0, columns - 2);
  const auto at = row_start + static_cast<std::size_t>(i);
  const double f = s - i;
  return (1 - f) * values[at] + f * values[at + 1];
}

Strand<2> resampled(const Strand<2>& strand, const Part& part) {
  const int columns = strand.points[0];
  Strand<2> cut = strand;
  cut.points[0] = std::max(1, static_cast<int>(std::lround(part.to - part.from)));
  const double step = (part.to - part.from) / cut.points[0];  // in columns of the strand
  cut.spacing[0] = strand.spacing[0] * step;
  for (auto* values : {&cut.x, &cut.v}) values->clear();
  cut.F.clear();
  cut.stress.clear();
  cut.plastic.clear();
  for (int j = 0; j < cut.points[1]; ++j) {
    const auto row = static_cast<std::size_t>(j) * static_cast<std::size_t>(columns);
    for (int i = 0; i < cut.points[0]; ++i) {
      const double s = part.from + (i + 0.5) * step - 0.5;
      const double within = std::clamp(s, 0.0, columns - 1.0);  // nothing but positions is extrapolated
      cut.x.push_back(between(strand.x, row, columns, s));
      cut.v.push_back(between(strand.v, row, columns, within));
      cut.F.push_back(between(strand.F, row, columns, within));
      cut.stress.push_back(between(strand.stress, row, columns, within));
      cut.plastic.push_back(between(strand.plastic, row, columns, within));
    }
  }
  return cut;
}

double volume(const Strand<2>& strand) {
  return strand.point_volume() * static_cast<double>(strand.points[0]) * strand.points[1];
}

}  // namespace

Specimen cut_to_window(const Panel<2>& panel) {
  constexpr double kSliver = 0.5;  // columns
  Specimen specimen;
  specimen.panel = panel;
  specimen.panel.strands.clear();
  double whole = 0, kept = 0;
  for (std::size_t s = 0; s < panel.strands.size(); ++s) {
    const auto& strand = panel.strands[s];
    whole += volume(strand);
    const auto line = mean_line(strand);
    const auto [low, high] = std::minmax_element(line.begin(), line.end());
    const double beyond = std::max(-*low, *high - panel.length_mm);
    if (beyond <= kCreep * strand.spacing[0]) {
      kept += volume(strand);
      specimen.panel.strands.push_back(strand);
      specimen.strand.push_back(static_cast<int>(s));
      continue;
    }
    specimen.furthest_mm = std::max(specimen.furthest_mm, beyond);
    const auto part = part_inside(line, panel.length_mm);
    if (!part || part->to - part->from < kSliver) {
      ++specimen.strands_outside;
      continue;
    }
    specimen.panel.strands.push_back(resampled(strand, *part));
    specimen.strand.push_back(static_cast<int>(s));
    kept += volume(specimen.panel.strands.back());
  }
  specimen.cut_fraction = whole > 0 ? 1 - kept / whole : 0;
  return specimen;
}

}  // namespace strandlab::vtest
