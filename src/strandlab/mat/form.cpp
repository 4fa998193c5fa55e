#include "strandlab/mat/form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "strandlab/core/error.hpp"
#include "strandlab/mat/cut.hpp"
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
  return s.length_mm == 0 && s.length_sd_mm == 0 && s.gap_mm == 0 && s.gap_sd_mm == 0 && s.width_mm == 0 &&
         s.width_sd_mm == 0;
}

// A strand and the gap behind it.
struct Cycle {
  Ticks strand = 0, gap = 0;
  double angle_deg = 0;
  Ticks total() const { return strand + gap; }
};

class CycleSource {
 public:
  CycleSource(const StrandStatistics& s, const AngleDistribution& angles) : given_(in_section(s, angles)) {
    if (are_cut(s, angles)) cuts_.emplace(s, angles);
    const double strand = cuts_ ? cuts_->longest_mm() : given_.length_mm + kNormalLimit * given_.length_sd_mm;
    longest_ = ticks(strand) + ticks(given_.gap_mm + kNormalLimit * given_.gap_sd_mm);
  }

  Cycle draw(RandomStream& random) const {
    Cycle cycle;
    while (cycle.strand == 0) draw_strand(cycle, random);
    if (given_.gap_mm > 0) cycle.gap = ticks(random.positive_normal(given_.gap_mm, given_.gap_sd_mm));
    return cycle;
  }

  Cycle draw_covering(RandomStream& random) const {
    for (;;) {
      const Cycle cycle = draw(random);
      if (random.uniform() * static_cast<double>(longest_) < static_cast<double>(cycle.total())) return cycle;
    }
  }

 private:
  void draw_strand(Cycle& cycle, RandomStream& random) const {
    if (!cuts_) {
      cycle.strand = ticks(random.positive_normal(given_.length_mm, given_.length_sd_mm));
      return;
    }
    const auto cut = cuts_->draw(random);
    cycle.strand = ticks(cut.length_mm);
    cycle.angle_deg = cut.angle_deg;
  }

  StrandStatistics given_;  // as the section shows them
  std::optional<CutSource> cuts_;
  Ticks longest_ = 0;
};

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
    if (row.statistics.width_mm != 0 || row.statistics.width_sd_mm != 0)
      check_normal(where, "width", row.statistics.width_mm, row.statistics.width_sd_mm, kSmallestSize_mm);
  }
}

std::vector<Strand> form_row(const LayupRow& row, Ticks window, RandomStream random) {
  std::vector<Strand> strands;
  const auto angles = row.angles.value_or(AngleDistribution{});
  const bool cut = are_cut(row.statistics, angles);
  const auto add = [&](Ticks x0, Ticks x1, double angle_deg) {
    if (static_cast<double>(x1 - x0) < kShortestPiece_mm * kTicksPerMm) return;
    Strand strand;
    strand.x0_mm = mm(x0);
    strand.x1_mm = mm(x1);
    if (cut) strand.angle_deg = angle_deg;
    strands.push_back(std::move(strand));
  };
  if (fills_row(row.statistics)) {
    add(0, window, 0);
    return strands;
  }
  for (const auto& whole : stationary_row(row.statistics, window, random, angles))
    add(std::max<Ticks>(whole.x0, 0), std::min(whole.x1, window), whole.angle_deg);
  return strands;
}

Layer form_layer(const Layup& layup, std::size_t i, Ticks window, std::uint64_t seed) {
  const auto& row = layup.rows[i];
  Layer layer;
  layer.role = row.kind;
  if (row.thickness_mm && *row.thickness_mm != layup.layer_thickness_mm) layer.thickness_mm = row.thickness_mm;
  layer.strands = form_row(row, window, RandomStream(seed, i));
  if (row.angles && !are_cut(row.statistics, *row.angles)) {
    const AngleSampler angles(*row.angles);
    RandomStream random(seed, kAngleStreams + i);
    for (auto& strand : layer.strands) strand.angle_deg = angles.draw(random);
  }
  return layer;
}

}  // namespace

std::vector<RowStrand> stationary_row(const StrandStatistics& statistics, Ticks window, RandomStream& random,
                                      const AngleDistribution& angles) {
  const CycleSource cycles(statistics, angles);
  std::vector<RowStrand> strands;
  Cycle cycle = cycles.draw_covering(random);
  Ticks x = -static_cast<Ticks>(random.uniform() * static_cast<double>(cycle.total()));
  for (;;) {
    strands.push_back({x, x + cycle.strand, cycle.angle_deg});
    if (x >= window) return strands;
    x += cycle.total();
    cycle = cycles.draw(random);
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
