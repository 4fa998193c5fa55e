#include "strandlab/mat/form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/mat/row.hpp"

namespace strandlab::mat {
namespace {

constexpr std::uint64_t kAngleStreams = std::uint64_t{1} << 32;  // streams of rows' angles; those of places lie below

Ticks ticks(double mm) {
  return std::llround(mm * kTicksPerMm);
}
double mm(Ticks t) {
  return static_cast<double>(t) / kTicksPerMm;
}

bool fills_row(const StrandStatistics& s) {
  return s.length_mm == 0 && s.length_sd_mm == 0 && s.gap_mm == 0 && s.gap_sd_mm == 0;
}

struct Cycle {
  Ticks strand, gap;
  Ticks total() const { return strand + gap; }
};

Cycle draw_cycle(const StrandStatistics& s, RandomStream& random) {
  Cycle cycle{0, 0};
  while (cycle.strand == 0) cycle.strand = ticks(random.positive_normal(s.length_mm, s.length_sd_mm));
  if (s.gap_mm > 0) cycle.gap = ticks(random.positive_normal(s.gap_mm, s.gap_sd_mm));
  return cycle;
}

Cycle draw_covering_cycle(const StrandStatistics& s, RandomStream& random) {
  const Ticks longest =
      ticks(s.length_mm + kNormalLimit * s.length_sd_mm) + ticks(s.gap_mm + kNormalLimit * s.gap_sd_mm);
  for (;;) {
    const Cycle cycle = draw_cycle(s, random);
    if (random.uniform() * static_cast<double>(longest) < static_cast<double>(cycle.total())) return cycle;
  }
}

void check_normal(const std::string& where, const char* name, double mean, double sd, double smallest) {
  if (!(mean >= smallest) || !(mean <= kLargestSize_mm)) {
    throw InputError(
        fmt::format("{}: {}_mm = {} must be between {} and {} mm", where, name, mean, smallest, kLargestSize_mm));
  }
  if (!(sd >= 0)) throw InputError(fmt::format("{}: {}_sd_mm = {} must not be negative", where, name, sd));
  if (sd > mean) {
    throw InputError(
        fmt::format("{}: {}_sd_mm = {} is larger than {}_mm = {}; the normal distribution, truncated to "
                    "positive values, would no longer have that mean and spread (allowed: 0 to {})",
                    where, name, sd, name, mean, mean));
  }
}

void check(const Layup& layup) {
  const auto positive = [](const std::string& what, double value) {
    if (!(value >= kSmallestSize_mm) || !(value <= kLargestSize_mm)) {
      throw InputError(
          fmt::format("{} = {} must be between {} and {} mm", what, value, kSmallestSize_mm, kLargestSize_mm));
    }
  };
  positive("layup: length_mm", layup.length_mm);
  positive("layup: layer_thickness_mm", layup.layer_thickness_mm);
  if (layup.rows.empty()) throw InputError("layup: no rows; a mat has at least one");
  for (std::size_t i = 0; i < layup.rows.size(); ++i) {
    const auto& row = layup.rows[i];
    const auto where = fmt::format("layup: row {} (\"{}\")", i + 1, row.kind);
    if (row.kind.empty()) throw InputError(fmt::format("{}: the strand kind has no name", where));
    if (row.thickness_mm) positive(where + ": thickness_mm", *row.thickness_mm);
    if (row.angles) mat::check(*row.angles, where);
    if (fills_row(row.statistics)) continue;
    check_normal(where, "length", row.statistics.length_mm, row.statistics.length_sd_mm, kSmallestSize_mm);
    check_normal(where, "gap", row.statistics.gap_mm, row.statistics.gap_sd_mm, 0);
  }
}

std::vector<Strand> form_row(const LayupRow& row, Ticks window, RandomStream random) {
  std::vector<Strand> strands;
  const auto add = [&](Ticks x0, Ticks x1) {
    if (static_cast<double>(x1 - x0) < kShortestPiece_mm * kTicksPerMm) return;
    Strand strand;
    strand.x0_mm = mm(x0);
    strand.x1_mm = mm(x1);
    strands.push_back(std::move(strand));
  };
  if (fills_row(row.statistics)) {
    add(0, window);
    return strands;
  }
  for (const auto& whole : stationary_row(row.statistics, window, random)) {
    add(std::max<Ticks>(whole.x0, 0), std::min(whole.x1, window));
  }
  return strands;
}

Layer form_layer(const Layup& layup, std::size_t i, Ticks window, std::uint64_t seed) {
  const auto& row = layup.rows[i];
  Layer layer;
  layer.role = row.kind;
  if (row.thickness_mm && *row.thickness_mm != layup.layer_thickness_mm) layer.thickness_mm = row.thickness_mm;
  layer.strands = form_row(row, window, RandomStream(seed, i));
  if (row.angles) {
    const AngleSampler angles(*row.angles);
    RandomStream random(seed, kAngleStreams + i);
    for (auto& strand : layer.strands) strand.angle_deg = angles.draw(random);
  }
  return layer;
}

}  // namespace

std::vector<RowStrand> stationary_row(const StrandStatistics& statistics, Ticks window, RandomStream& random) {
  std::vector<RowStrand> strands;
  Cycle cycle = draw_covering_cycle(statistics, random);
  Ticks x = -static_cast<Ticks>(random.uniform() * static_cast<double>(cycle.total()));
  for (;;) {
    strands.push_back({x, x + cycle.strand});
    if (x >= window) return strands;
    x += cycle.total();
    cycle = draw_cycle(statistics, random);
  }
}

Mat form(const Layup& layup, std::uint64_t seed) {
  check(layup);
  const Ticks window = ticks(layup.length_mm);
  Mat mat;
  mat.length_mm = mm(window);
  mat.layer_thickness_mm = layup.layer_thickness_mm;
  for (std::size_t i = 0; i < layup.rows.size(); ++i) {
    Layer layer = form_layer(layup, i, window, seed);
    if (layer.strands.empty()) {
      throw InputError(
          fmt::format("layup: row {} (\"{}\"): the window of {} mm lies within one gap and the row has no "
                      "strand; lengthen the mat or take another seed than {}",
                      i + 1, layer.role, mat.length_mm, seed));
    }
    mat.layers.push_back(std::move(layer));
  }
  return mat;
}

}  // namespace strandlab::mat
