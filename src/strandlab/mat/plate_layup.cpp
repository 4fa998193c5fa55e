#include "strandlab/mat/plate_layup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/mat/form.hpp"

namespace strandlab::mat {
namespace {

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw InputError(fmt::format("{}: {}", where, what));
}

void check_positive(const std::string& where, const char* name, double mm) {
  if (mm >= kSmallestSize_mm && mm <= kLargestSize_mm) return;
  refuse(where, fmt::format("{} = {} must be between {} and {} mm", name, mm, kSmallestSize_mm, kLargestSize_mm));
}

void check_size_statistics(const std::string& where, const SizeStatistics& s) {
  const auto check_normal = [&](const char* name, double mean, double sd) {
    check_positive(where, name, mean);
    if (sd >= 0 && sd <= mean) return;
    refuse(where, fmt::format("the standard deviation of {} = {} mm is {}: it must be between 0 and the mean", name,
                              mean, sd));
  };
  check_normal("length_mm", s.length_mm, s.length_sd_mm);
  check_normal("width_mm", s.width_mm, s.width_sd_mm);
}

bool one_angle(const AngleDistribution& a) {
  return a.spread_deg == 0 && a.sd_deg == 0 && a.kappa == 0;
}

// The least window in which a strand never meets its own image: that of a strand along x or y is its outline, that of
// another its diagonal both ways, which is enough at any angle.
Window least_window(const PlateRow& row, double gap_mm) {
  const double length = row.sizes.length_mm + gap_mm, width = row.sizes.width_mm + gap_mm;
  const double diagonal = std::sqrt(length * length + width * width);
  if (!one_angle(row.angles) || std::remainder(row.angles.mean_deg, 90.0) != 0) return {diagonal, diagonal, true};
  if (std::remainder(row.angles.mean_deg, 180.0) == 0) return {length, width, true};
  return {width, length, true};
}

// The mean strand at its mean angle finds room for itself.
void check_own_image(const std::string& where, const PlateLayup& layup, const PlateRow& row) {
  const auto& s = row.sizes;
  const double gap = layup.stack == Stack::kLayers ? layup.sequential.in_layer_gap_mm : 0;
  const double longest = std::max(s.length_mm, s.width_mm);
  const auto least = least_window(row, gap);
  if (longest <= 10 * std::min(layup.length_mm, layup.width_mm)) {  // else the images would be many
    const auto strand = rectangle(0, 0, s.length_mm, s.width_mm, row.angles.mean_deg);
    if (!own_image_within(gap, strand, {layup.length_mm, layup.width_mm, true})) return;
  }
  refuse(where,
         fmt::format("a strand of {} x {} mm at {} degrees meets its own image in a window of {} x {} mm that "
                     "repeats; {} is {:.1f} x {:.1f} mm",
                     s.length_mm, s.width_mm, row.angles.mean_deg, layup.length_mm, layup.width_mm,
                     one_angle(row.angles) ? "the least window" : "a window in which it never does, at any angle,",
                     std::ceil(10 * least.x) / 10, std::ceil(10 * least.y) / 10));
}

void check_fines(const std::string& where, const PlateLayup& layup, const PlateRow& row) {
  double shares = 0;
  for (const auto& fines : row.fines) {
    check_size_statistics(where + ", fines", fines.sizes);
    if (fines.mass_share && !(*fines.mass_share > 0))
      refuse(where, fmt::format("the share of fines by mass = {} must be positive", *fines.mass_share));
    if (!fines.mass_share && layup.stack == Stack::kDraped)
      refuse(where, "fines of a draped mat need a share by mass, since any number of strands finds a place");
    shares += fines.mass_share.value_or(0);
  }
  if (!(shares < 1)) refuse(where, fmt::format("the shares of fines by mass make {}: they must stay below 1", shares));
}

void check_plate_row(const std::string& where, const PlateLayup& layup, const PlateRow& row) {
  if (row.kind.empty()) refuse(where, "the strand kind has no name");
  if (row.thickness_mm) check_positive(where, "thickness_mm", *row.thickness_mm);
  check_size_statistics(where, row.sizes);
  check(row.angles, where);
  check_fines(where, layup, row);
  if (layup.sides == PlateSides::kPeriodic) {
    check_own_image(where, layup, row);
  } else if (!one_angle(row.angles) || std::remainder(row.angles.mean_deg, 90.0) != 0) {
    refuse(where,
           fmt::format("strands at {} degrees{}: those of a cut mat all lie at 0 or 90 degrees; turned ones need "
                       "periodic sides",
                       row.angles.mean_deg, one_angle(row.angles) ? "" : ", each at its own"));
  }
}

// As many strands as would cover the window once, fines among them, and of a draped mat in all its rows.
void check_number(const PlateLayup& layup) {
  double strands = 0;
  for (const auto& row : layup.rows) {
    double least = row.sizes.length_mm * row.sizes.width_mm;
    for (const auto& fines : row.fines) least = std::min(least, fines.sizes.length_mm * fines.sizes.width_mm);
    const double of_row = layup.length_mm * layup.width_mm / least;
    strands = layup.stack == Stack::kDraped ? strands + of_row : std::max(strands, of_row);
  }
  if (strands <= kMostStrands) return;
  refuse("layup", fmt::format("a window of {} x {} mm would take about {:.3g} strands{}, more than {}; take a smaller "
                              "window or larger strands",
                              layup.length_mm, layup.width_mm, strands, layup.stack == Stack::kDraped ? "" : " a layer",
                              kMostStrands));
}

}  // namespace

void check(const PlateLayup& layup) {
  check_positive("layup", "length_mm", layup.length_mm);
  check_positive("layup", "width_mm", layup.width_mm);
  check_positive("layup", "layer_thickness_mm", layup.layer_thickness_mm);
  const auto& options = layup.sequential;
  if (!(options.in_layer_gap_mm >= 0) || !(options.in_layer_gap_mm <= kLargestSize_mm))
    refuse("layup", fmt::format("in_layer_gap_mm = {} must not be negative", options.in_layer_gap_mm));
  if (options.rsa_failures < 1)
    refuse("layup", fmt::format("rsa_failures = {} must be 1 or more", options.rsa_failures));
  if (layup.stack == Stack::kDraped && layup.sides == PlateSides::kCut)
    refuse("layup", "a draped mat has periodic sides");
  if (layup.drape_slopes.size() != 2)
    refuse("layup", fmt::format("drape_slopes has {} numbers; it has two, along and across a strand",
                                layup.drape_slopes.size()));
  if (layup.rows.empty()) refuse("layup", "no rows; a mat has at least one");
  for (std::size_t i = 0; i < layup.rows.size(); ++i)
    check_plate_row(fmt::format("layup: row {} (\"{}\")", i + 1, layup.rows[i].kind), layup, layup.rows[i]);
  check_number(layup);
}

}  // namespace strandlab::mat
