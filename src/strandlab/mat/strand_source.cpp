#include "strandlab/mat/strand_source.hpp"

#include <cmath>

#include "strandlab/mat/mat.hpp"
#include "strandlab/mat/raster.hpp"

namespace strandlab::mat {
namespace {

double draw_size(double mean, double sd, RandomStream& random) {
  double size = 0;
  while (size < kShortestPiece_mm) size = on_raster(random.positive_normal(mean, sd));
  return size;
}

}  // namespace

double off_angle(double angle_deg, double other_deg) {
  return std::abs(std::remainder(angle_deg - other_deg, 180.0));
}

StrandSource::StrandSource(const AngleDistribution& angles, const Window& window, RandomStream random)
    : mean_deg_(angles.mean_deg), angles_(angles), window_(window), random_(random) {}

PlateStrand StrandSource::draw(const SizeStatistics& sizes) {
  PlateStrand strand;
  strand.length_mm = draw_size(sizes.length_mm, sizes.length_sd_mm, random_);
  strand.width_mm = draw_size(sizes.width_mm, sizes.width_sd_mm, random_);
  strand.angle_deg = angles_.draw(random_);
  ++drawn_.count;
  drawn_.sum_off_mean_deg += off_angle(*strand.angle_deg, mean_deg_);
  return strand;
}

void StrandSource::lay_anywhere(PlateStrand& strand) {
  strand.cx_mm = on_raster(window_.x * random_.uniform());
  strand.cy_mm = on_raster(window_.y * random_.uniform());
}

}  // namespace strandlab::mat
