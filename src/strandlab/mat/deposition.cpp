#include "strandlab/mat/deposition.hpp"

#include <fmt/format.h>

#include <cmath>

#include "strandlab/core/error.hpp"

namespace strandlab::mat {
namespace {

struct SizeClass {
  SizeStatistics sizes;
  double number_share = 0;  // of all strands of the row

  double area() const { return sizes.length_mm * sizes.width_mm; }
};

std::vector<SizeClass> size_classes(const PlateRow& row) {
  double main_share = 1, number = 0;
  for (const auto& fines : row.fines) main_share -= fines.mass_share.value();
  std::vector<SizeClass> classes{{row.sizes, main_share}};
  for (const auto& fines : row.fines) classes.push_back({fines.sizes, fines.mass_share.value()});
  for (auto& c : classes) number += c.number_share /= c.area();
  for (auto& c : classes) c.number_share /= number;
  return classes;
}

const SizeStatistics& class_at(double u, const std::vector<SizeClass>& classes) {
  for (const auto& c : classes) {
    if (u < c.number_share) return c.sizes;
    u -= c.number_share;
  }
  return classes.back().sizes;
}

}  // namespace

RandomLayer deposited_layer(const PlateRow& row, double mean_count, const Window& torus, RandomStream random) {
  const auto classes = size_classes(row);
  double mean_area = 0;
  for (const auto& c : classes) mean_area += c.number_share * c.area();
  const auto count = std::llround(mean_count * torus.x * torus.y / mean_area);
  StrandSource source(row.angles, torus, random);
  RandomLayer layer;
  for (long long i = 0; i < count; ++i) {
    auto strand = source.draw(class_at(source.uniform(), classes));
    source.lay_anywhere(strand);
    if (own_image_within(0, outline(strand, *strand.angle_deg), torus)) {
      throw InputError(
          fmt::format("a strand of {:.1f} x {:.1f} mm at {:.1f} degrees meets its own image in a window of "
                      "{} x {} mm that repeats; widen the window",
                      strand.length_mm, strand.width_mm, *strand.angle_deg, torus.x, torus.y));
    }
    layer.strands.push_back(strand);
  }
  layer.drawn = source.drawn();
  return layer;
}

}  // namespace strandlab::mat
