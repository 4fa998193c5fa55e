#include "strandlab/mat/sequential.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace strandlab::mat {
namespace {

class SequentialLayer {
 public:
  SequentialLayer(const PlateRow& row, const Window& torus, const SequentialOptions& options, RandomStream random)
      : source_(row.angles, torus, random), torus_(torus), options_(options) {}

  // Places strands of these sizes until no more find a place or their area is `most_mm2`; returns their area, mm^2.
  double add(const SizeStatistics& sizes, double most_mm2) {
    double area = 0;
    PlateStrand strand;
    bool another = true;
    for (int failures = 0; failures < options_.rsa_failures && area < most_mm2;) {
      if (another) strand = source_.draw(sizes);
      source_.lay_anywhere(strand);
      const bool placed = place(strand);
      if (placed) area += strand.length_mm * strand.width_mm;
      failures = placed ? 0 : failures + 1;
      another = placed || !options_.keep_angle;
    }
    return area;
  }

  RandomLayer take() { return {std::move(strands_), source_.drawn()}; }

 private:
  bool place(const PlateStrand& strand) {
    const double gap = options_.in_layer_gap_mm;
    const auto its = outline(strand, *strand.angle_deg);
    if (own_image_within(gap, its, torus_)) return false;
    for (const auto& other : outlines_) {
      if (image_within(gap, its, other, torus_)) return false;
    }
    outlines_.push_back(its);
    strands_.push_back(strand);
    return true;
  }

  StrandSource source_;
  Window torus_;
  SequentialOptions options_;
  std::vector<Rectangle> outlines_;
  std::vector<PlateStrand> strands_;
};

}  // namespace

RandomLayer sequential_layer(const PlateRow& row, const Window& torus, const SequentialOptions& options,
                             RandomStream random) {
  constexpr double kAnyArea = std::numeric_limits<double>::infinity();
  SequentialLayer layer(row, torus, options, random);
  const double area = layer.add(row.sizes, kAnyArea);
  double shares = 0;
  for (const auto& fines : row.fines) shares += fines.mass_share.value_or(0);
  for (const auto& fines : row.fines)
    layer.add(fines.sizes, fines.mass_share ? *fines.mass_share / (1 - shares) * area : kAnyArea);
  return layer.take();
}

}  // namespace strandlab::mat
