// What a random mat of a plate is formed from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "strandlab/mat/angles.hpp"
#include "strandlab/mat/plate.hpp"

namespace strandlab::mat {

// Sizes of whole strands: length along the grain and width, normal, truncated to positive values.
struct SizeStatistics {
  double length_mm = 150, length_sd_mm = 0;
  double width_mm = 25, width_sd_mm = 0;
};

// Smaller strands among those of a kind.
struct Fines {
  SizeStatistics sizes;
  std::optional<double> mass_share = {};  // of all strands of the kind; else as many as find a place (layers only)
};

struct PlateRow {
  std::string kind;  // strand kind, becomes the layer's role
  SizeStatistics sizes;
  AngleDistribution angles;
  std::optional<double> thickness_mm = {};  // else the layup's layer_thickness_mm
  std::vector<Fines> fines = {};            // largest first
};

// Random sequential addition: strands are laid one by one where they meet no other, until no more find a place.
struct SequentialOptions {
  double in_layer_gap_mm = 0.2;  // least distance of the strands of a layer, so that neighbours share no contact
  int rsa_failures = 20000;      // a layer ends when so many strands in a row have found no place
  bool keep_angle = false;       // a strand that finds no place is tried elsewhere, in place of another strand
};

inline constexpr double kMostStrands = 30000;  // of a layer, each of which is tried against all others; of a draped mat

struct PlateLayup {
  double length_mm = 254, width_mm = 254;
  double layer_thickness_mm = 0.8;
  PlateSides sides = PlateSides::kPeriodic;
  Stack stack = Stack::kLayers;
  std::vector<double> drape_slopes{0.1, 0.2};  // along and across a strand
  SequentialOptions sequential;
  std::vector<PlateRow> rows;  // bottom to top
};

// Throws InputError (row, counted from 1, what is wrong): a size that is not positive, a standard deviation above its
// mean, a strand that meets its own image in this window (with the least window), shares of more than the whole, turned
// strands in a cut mat, more than kMostStrands strands.
void check(const PlateLayup& layup);

}  // namespace strandlab::mat
