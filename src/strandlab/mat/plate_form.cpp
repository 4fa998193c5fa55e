#include "strandlab/mat/plate_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "strandlab/core/error.hpp"
#include "strandlab/mat/deposition.hpp"
#include "strandlab/mat/mat.hpp"
#include "strandlab/mat/raster.hpp"

namespace strandlab::mat {
namespace {

// The part of a strand along x or y, moved by (dx, dy), that lies in the window; nothing where too little does.
std::optional<PlateStrand> part_within(const Window& window, PlateStrand strand, double dx, double dy) {
  const bool upright = std::remainder(*strand.angle_deg, 180.0) != 0;
  const auto clip = [](double& centre, double& size, double side) {
    const double low = std::max(0.0, centre - size / 2), high = std::min(side, centre + size / 2);
    centre = on_raster((low + high) / 2);
    size = on_raster(high - low);
    return size >= kShortestPiece_mm;
  };
  strand.cx_mm += dx;
  strand.cy_mm += dy;
  const bool in_x = clip(strand.cx_mm, upright ? strand.width_mm : strand.length_mm, window.x);
  const bool in_y = clip(strand.cy_mm, upright ? strand.length_mm : strand.width_mm, window.y);
  return in_x && in_y ? std::optional(strand) : std::nullopt;
}

std::vector<PlateStrand> parts_within(const Window& window, const std::vector<PlateStrand>& strands,
                                      const Window& torus) {
  std::vector<PlateStrand> parts;
  for (const auto& strand : strands) {
    for (const double dx : {-torus.x, 0.0, torus.x}) {
      for (const double dy : {-torus.y, 0.0, torus.y}) {
        if (auto part = part_within(window, strand, dx, dy)) parts.push_back(std::move(*part));
      }
    }
  }
  return parts;
}

// The torus of which a cut mat is a window: larger by twice its longest strand, which does not meet its own image
// there.
Window torus_around(const PlateLayup& layup) {
  double longest = 0;
  for (const auto& row : layup.rows) longest = std::max({longest, row.sizes.length_mm, row.sizes.width_mm});
  const double margin = 2 * (longest + layup.sequential.in_layer_gap_mm);
  return {on_raster(layup.length_mm + margin), on_raster(layup.width_mm + margin), true};
}

RandomLayer layer_of(const PlateLayup& layup, const PlateRow& row, RandomStream random) {
  const Window window{layup.length_mm, layup.width_mm, true};
  if (layup.sides == PlateSides::kPeriodic) return sequential_layer(row, window, layup.sequential, random);
  const auto torus = torus_around(layup);
  auto layer = sequential_layer(row, torus, layup.sequential, random);
  layer.strands = parts_within(window, layer.strands, torus);
  return layer;
}

// Rows of one kind that follow each other.
std::size_t rows_alike(const PlateLayup& layup, std::size_t first) {
  std::size_t last = first + 1;
  while (last < layup.rows.size() && layup.rows[last].kind == layup.rows[first].kind) ++last;
  return last - first;
}

}  // namespace

FormedPlate form(const PlateLayup& layup, std::uint64_t seed) {
  check(layup);
  FormedPlate formed;
  auto& mat = formed.mat;
  mat.length_mm = on_raster(layup.length_mm);
  mat.width_mm = on_raster(layup.width_mm);
  mat.layer_thickness_mm = layup.layer_thickness_mm;
  mat.sides = layup.sides;
  mat.stack = layup.stack;
  mat.drape_slopes = {layup.drape_slopes[0], layup.drape_slopes[1]};
  const bool draped = layup.stack == Stack::kDraped;
  for (std::size_t i = 0; i < layup.rows.size();) {
    const auto& row = layup.rows[i];
    const std::size_t rows = draped ? rows_alike(layup, i) : 1;
    const RandomStream random(seed, mat.layers.size());
    auto layer =
        draped ? deposited_layer(row, static_cast<double>(rows), mat.window(), random) : layer_of(layup, row, random);
    if (layer.strands.empty()) {
      throw InputError(
          fmt::format("layup: row {} (\"{}\"): no strand lies in the window of {} x {} mm; take a larger "
                      "window or another seed than {}",
                      i + 1, row.kind, mat.length_mm, mat.width_mm, seed));
    }
    formed.drawn.push_back(layer.drawn);
    mat.layers.push_back({row.kind, std::move(layer.strands), {}, row.thickness_mm});
    i += rows;
  }
  return formed;
}

double coverage(const PlateMat& mat, std::size_t layer) {
  double area = 0;
  for (const auto& strand : mat.layers[layer].strands) area += strand.length_mm * strand.width_mm;
  return area / (mat.length_mm * mat.width_mm);
}

double mean_off(double mean_deg, const PlateLayer& layer) {
  double sum = 0;
  for (const auto& strand : layer.strands) sum += off_angle(strand.angle_deg.value(), mean_deg);
  return sum / static_cast<double>(layer.strands.size());
}

}  // namespace strandlab::mat
