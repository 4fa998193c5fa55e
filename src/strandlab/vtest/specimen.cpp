#include "strandlab/vtest/specimen.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace strandlab::vtest {
namespace {

// Mean x of each column of a strand's corner lattice, from its left end to its right one.
std::vector<double> mean_line(const Strand<2>& strand) {
  const auto position = corners(strand);
  std::vector<double> line(static_cast<std::size_t>(strand.lattice.counts[0]) + 1, 0.0);
  for (std::size_t c = 0; c < position.size(); ++c) line[strand.lattice.place_of_corner(c)[0]] += position[c][0];
  for (double& x : line) x /= strand.lattice.counts[1] + 1;
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

// Value of a row's points at column s + 1/2 of the lattice: linear between points and beyond the last.
template <class Value>
Value between(const std::vector<Value>& values, const Lattice<2>& lattice, int row, double s) {
  const int columns = lattice.counts[0];
  if (columns == 1) return values[lattice.point({0, row})];
  const int i = std::clamp(static_cast<int>(std::floor(s)), 0, columns - 2);
  const auto at = lattice.point({i, row});
  const double f = s - i;
  return (1 - f) * values[at] + f * values[at + 1];
}

Strand<2> resampled(const Strand<2>& strand, const Part& part) {
  const auto& lattice = strand.lattice;
  Strand<2> cut = strand;
  cut.lattice.counts[0] = std::max(1, static_cast<int>(std::lround(part.to - part.from)));
  const double step = (part.to - part.from) / cut.lattice.counts[0];  // in columns of the strand
  cut.lattice.spacing[0] = lattice.spacing[0] * step;
  for_each_field_of<2>(strand.points, [&](const auto& field) {
    auto& values = cut.points.*field.values;
    set_zero(values, cut.lattice.size());
    for (std::size_t p = 0; p < values.size(); ++p) {
      const auto [i, row] = cut.lattice.place_of_point(p);
      double s = part.from + (i + 0.5) * step - 0.5;
      if (field.resampled == Resampled::kHeld) s = std::clamp(s, 0.0, lattice.counts[0] - 1.0);
      values[p] = between(strand.points.*field.values, lattice, row, s);
    }
  });
  return cut;
}

double volume(const Strand<2>& strand) {
  return strand.lattice.point_volume() * static_cast<double>(strand.lattice.counts[0]) * strand.lattice.counts[1];
}

}  // namespace

Specimen cut_to_window(const Panel<2>& panel) {
  constexpr double kSliverColumns = 0.5;  // columns
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
    if (beyond <= kCreep * strand.lattice.spacing[0]) {
      kept += volume(strand);
      specimen.panel.strands.push_back(strand);
      specimen.strand.push_back(static_cast<int>(s));
      continue;
    }
    specimen.furthest_mm = std::max(specimen.furthest_mm, beyond);
    const auto part = part_inside(line, panel.length_mm);
    if (!part || part->to - part->from < kSliverColumns) {
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
