#include "strandlab/mat/drape.hpp"

#include <algorithm>
#include <cmath>

namespace strandlab::mat {
namespace {

constexpr double kTouching = 0.01;  // of a thickness

std::size_t whole(double size, double cell) {
  return static_cast<std::size_t>(std::max(1.0, std::round(size / cell)));
}

// The upper surface of what lies already, at the nodes of a raster on the torus.
class Surface {
 public:
  Surface(const Window& window, double spacing)
      : nx_(whole(window.x, spacing)),
        ny_(whole(window.y, spacing)),
        dx_(window.x / static_cast<double>(nx_)),
        dy_(window.y / static_cast<double>(ny_)),
        height_(nx_ * ny_, 0.0) {}

  double read(double x, double y) const {
    const double i = std::floor(x / dx_), j = std::floor(y / dy_), u = x / dx_ - i, v = y / dy_ - j;
    return (1 - v) * ((1 - u) * node(i, j) + u * node(i + 1, j)) +
           v * ((1 - u) * node(i, j + 1) + u * node(i + 1, j + 1));
  }

  // Nodes within the outline, as they are or lower, become height(u, v), u and v along and across from the centre.
  template <class Height>
  void raise(const Rectangle& strand, const Height& height) {
    const double reach_x = strand.half_length * std::abs(strand.cos) + strand.half_width * std::abs(strand.sin);
    const double reach_y = strand.half_length * std::abs(strand.sin) + strand.half_width * std::abs(strand.cos);
    for (double j = std::ceil((strand.cy - reach_y) / dy_); j <= std::floor((strand.cy + reach_y) / dy_); ++j) {
      for (double i = std::ceil((strand.cx - reach_x) / dx_); i <= std::floor((strand.cx + reach_x) / dx_); ++i) {
        const double x = i * dx_ - strand.cx, y = j * dy_ - strand.cy;
        const double u = x * strand.cos + y * strand.sin, v = y * strand.cos - x * strand.sin;
        if (std::abs(u) > strand.half_length || std::abs(v) > strand.half_width) continue;
        auto& top = height_[index(i, j)];
        top = std::max(top, height(u, v));
      }
    }
  }

  double mean() const {
    double sum = 0;
    for (const double h : height_) sum += h;
    return sum / static_cast<double>(height_.size());
  }
  double highest() const { return *std::max_element(height_.begin(), height_.end()); }

 private:
  static std::size_t wrapped(double k, std::size_t n) {
    const auto period = static_cast<double>(n);
    return static_cast<std::size_t>(k - period * std::floor(k / period));
  }
  std::size_t index(double i, double j) const { return wrapped(i, nx_) + nx_ * wrapped(j, ny_); }
  double node(double i, double j) const { return height_[index(i, j)]; }

  std::size_t nx_, ny_;
  double dx_, dy_;
  std::vector<double> height_;
};

// Raises values so that neighbours differ by `most` at the most: passages forward and backward.
template <class At>
void limit_steps(std::size_t count, double most, const At& at) {
  for (std::size_t k = 1; k < count; ++k) at(k) = std::max(at(k), at(k - 1) - most);
  for (std::size_t k = count - 1; k-- > 0;) at(k) = std::max(at(k), at(k + 1) - most);
}

class Draper {
 public:
  Draper(const PlateMat& mat, double cell_mm)
      : slopes_(mat.drape_slopes), cell_(cell_mm), surface_(mat.window(), cell_mm / 2) {}

  DrapedStrand lay(const Rectangle& outline, double thickness) {
    DrapedStrand strand;
    strand.along = whole(2 * outline.half_length, cell_);
    strand.across = whole(2 * outline.half_width, cell_);
    const double du = 2 * outline.half_length / static_cast<double>(strand.along);
    const double dv = 2 * outline.half_width / static_cast<double>(strand.across);
    for (std::size_t j = 0; j <= strand.across; ++j) {
      for (std::size_t i = 0; i <= strand.along; ++i) {
        const double u = static_cast<double>(i) * du - outline.half_length;
        const double v = static_cast<double>(j) * dv - outline.half_width;
        strand.lower_mm.push_back(surface_.read(outline.cx + u * outline.cos - v * outline.sin,
                                                outline.cy + u * outline.sin + v * outline.cos));
      }
    }
    const auto below = strand.lower_mm;
    bend(strand, slopes_[0] * du, slopes_[1] * dv);
    count_touching(strand, below, kTouching * thickness, du * dv);
    raise_surface(outline, strand, thickness);
    return strand;
  }

  double touching() const { return touching_area_ / area_; }
  const Surface& surface() const { return surface_; }

 private:
  static void bend(DrapedStrand& strand, double step_along, double step_across) {
    const std::size_t row = strand.along + 1;
    auto& z = strand.lower_mm;
    for (std::size_t j = 0; j <= strand.across; ++j)
      limit_steps(row, step_along, [&](std::size_t i) -> double& { return z[i + j * row]; });
    for (std::size_t i = 0; i < row; ++i)
      limit_steps(strand.across + 1, step_across, [&](std::size_t j) -> double& { return z[i + j * row]; });
  }

  // Each corner stands for the quarters of the cells around it.
  void count_touching(const DrapedStrand& strand, const std::vector<double>& below, double gap, double cell_area) {
    const std::size_t row = strand.along + 1;
    for (std::size_t k = 0; k < below.size(); ++k) {
      const bool end = k % row == 0 || k % row == strand.along;
      const bool edge = k / row == 0 || k / row == strand.across;
      const double area = cell_area * (end ? 0.5 : 1) * (edge ? 0.5 : 1);
      area_ += area;
      if (strand.lower_mm[k] - below[k] <= gap) touching_area_ += area;
    }
  }

  void raise_surface(const Rectangle& outline, const DrapedStrand& strand, double thickness) {
    const auto cells_along = static_cast<double>(strand.along), cells_across = static_cast<double>(strand.across);
    surface_.raise(outline, [&](double u, double v) {
      const double a = (u / outline.half_length + 1) / 2 * cells_along;
      const double b = (v / outline.half_width + 1) / 2 * cells_across;
      const auto i = std::min(static_cast<std::size_t>(a), strand.along - 1);
      const auto j = std::min(static_cast<std::size_t>(b), strand.across - 1);
      const double p = a - static_cast<double>(i), q = b - static_cast<double>(j);
      return thickness + (1 - q) * ((1 - p) * strand.at(i, j) + p * strand.at(i + 1, j)) +
             q * ((1 - p) * strand.at(i, j + 1) + p * strand.at(i + 1, j + 1));
    });
  }

  std::array<double, 2> slopes_;
  double cell_;
  Surface surface_;
  double touching_area_ = 0, area_ = 0;
};

}  // namespace

Drape drape(const PlateMat& mat, const std::vector<RoleAngle>& roles, double cell_mm) {
  Draper draper(mat, cell_mm);
  Drape result;
  for (std::size_t i = 0; i < mat.layers.size(); ++i) {
    result.layers.emplace_back();
    for (const auto& strand : mat.layers[i].strands) {
      const auto its = outline(strand, angle_deg(strand, mat.layers[i].role, roles));
      result.layers.back().push_back(draper.lay(its, mat.thickness_of(i)));
    }
  }
  result.mean_top_mm = draper.surface().mean();
  result.highest_mm = draper.surface().highest();
  result.touching = draper.touching();
  return result;
}

}  // namespace strandlab::mat
