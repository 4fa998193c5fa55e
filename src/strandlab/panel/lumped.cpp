#include "strandlab/panel/lumped.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace strandlab {
namespace {

// Share of fine cell k that lies within low..high, in units of fine cells.
double covered(int k, double low, double high) {
  return std::max(0.0, std::min(high, k + 1.0) - std::max(low, static_cast<double>(k)));
}

// The fine corner lattice at a place given in fine cells, between its corners by linear interpolation.
Vec<2> corner_at(const std::vector<Vec<2>>& fine, const std::array<int, 2>& points, double i, double j) {
  const int i0 = std::min(static_cast<int>(i), points[0] - 1), j0 = std::min(static_cast<int>(j), points[1] - 1);
  const double fi = i - i0, fj = j - j0;
  const auto at = [&](int a, int b) { return fine[static_cast<std::size_t>(b) * (points[0] + 1) + a]; };
  return (1 - fj) * ((1 - fi) * at(i0, j0) + fi * at(i0 + 1, j0)) +
         fj * ((1 - fi) * at(i0, j0 + 1) + fi * at(i0 + 1, j0 + 1));
}

Strand<2> lumped(const Strand<2>& fine, double spacing_along_mm, int points_through) {
  Strand<2> s;
  s.kind = fine.kind;
  s.row = fine.row;
  s.angle_deg = fine.angle_deg;
  s.material = fine.material;
  s.stiffness_factor = fine.stiffness_factor;
  const double length = fine.points[0] * fine.spacing[0], thickness = fine.points[1] * fine.spacing[1];
  s.points = {std::clamp(static_cast<int>(std::lround(length / spacing_along_mm)), 1, fine.points[0]),
              std::min(points_through, fine.points[1])};
  s.spacing = {length / s.points[0], thickness / s.points[1]};
  const auto lattice = corners(fine);
  const double step_i = static_cast<double>(fine.points[0]) / s.points[0];
  const double step_j = static_cast<double>(fine.points[1]) / s.points[1];
  for (int j = 0; j < s.points[1]; ++j) {
    for (int i = 0; i < s.points[0]; ++i) {
      const double low_i = i * step_i, high_i = low_i + step_i, low_j = j * step_j, high_j = low_j + step_j;
      const Vec<2> a = corner_at(lattice, fine.points, low_i, low_j),
                   b = corner_at(lattice, fine.points, high_i, low_j),
                   c = corner_at(lattice, fine.points, low_i, high_j),
                   d = corner_at(lattice, fine.points, high_i, high_j);
      s.x.emplace_back(0.25 * (a + b + c + d));
      Tensor<2> F;
      F.col(0) = (b + d - a - c) / (2 * s.spacing[0]);
      F.col(1) = (c + d - a - b) / (2 * s.spacing[1]);
      s.F.push_back(F);
      Voigt stress = Voigt::Zero();
      double plastic = 0;
      for (int fj = static_cast<int>(low_j); fj < std::min(fine.points[1], static_cast<int>(std::ceil(high_j))); ++fj) {
        for (int fi = static_cast<int>(low_i); fi < std::min(fine.points[0], static_cast<int>(std::ceil(high_i)));
             ++fi) {
          const double share = covered(fi, low_i, high_i) * covered(fj, low_j, high_j) / (step_i * step_j);
          const auto p = static_cast<std::size_t>(fj) * fine.points[0] + fi;
          stress += share * fine.stress[p];
          plastic += share * fine.plastic[p];
        }
      }
      s.stress.push_back(stress);
      s.plastic.push_back(plastic);
    }
  }
  s.v.assign(s.x.size(), Vec<2>::Zero());
  return s;
}

}  // namespace

Panel<2> lumped(const Panel<2>& panel, double spacing_along_mm, int points_through) {
  if (!(spacing_along_mm > 0) || points_through < 1) throw std::invalid_argument("lumped: no points to lump to");
  Panel<2> coarse = panel;
  for (auto& strand : coarse.strands) strand = lumped(strand, spacing_along_mm, points_through);
  return coarse;
}

}  // namespace strandlab
