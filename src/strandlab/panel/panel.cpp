#include "strandlab/panel/panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"

namespace strandlab {
namespace {

const StrandKind& find_kind(const std::vector<StrandKind>& kinds, const std::string& role, std::size_t layer) {
  for (const auto& kind : kinds) {
    if (kind.name == role) return kind;
  }
  throw InputError(fmt::format("layer {}: role \"{}\" is not a strand kind of the case", layer + 1, role));
}

wood::Material find_material(const StrandKind& kind, const mat::Strand& strand, const std::vector<StrandKind>& kinds) {
  if (!strand.material || *strand.material == kind.material.name) return kind.material;
  for (const auto& other : kinds) {
    if (other.material.name == *strand.material) return other.material;
  }
  for (const auto& built_in : wood::library()) {
    if (built_in.name == *strand.material) return built_in;
  }
  throw InputError(fmt::format("strand at x = {} mm: unknown material \"{}\"", strand.x0_mm, *strand.material));
}

}  // namespace

Panel<2> make_panel(const mat::Mat& mat, const std::vector<StrandKind>& kinds, double spacing_along_mm,
                    int points_through) {
  Panel<2> panel;
  panel.length_mm = mat.length_mm;
  panel.initial_thickness_mm = mat.layer_thickness_mm * static_cast<double>(mat.layers.size());
  panel.top_mm = panel.initial_thickness_mm;
  for (std::size_t row = 0; row < mat.layers.size(); ++row) {
    const auto& kind = find_kind(kinds, mat.layers[row].role, row);
    for (const auto& piece : mat.layers[row].strands) {
      Strand<2> s;
      s.kind = kind.name;
      s.row = static_cast<int>(row);
      s.angle_deg = piece.angle_deg.value_or(kind.angle_deg);
      s.material = wood::in_strand_axes(find_material(kind, piece, kinds), s.angle_deg);
      const double length = piece.x1_mm - piece.x0_mm;
      const int along = std::max(1, static_cast<int>(std::lround(length / spacing_along_mm)));
      s.points = {along, points_through};
      s.spacing = {length / along, mat.layer_thickness_mm / points_through};
      const double y0 = mat.layer_thickness_mm * static_cast<double>(row);
      const std::size_t n = static_cast<std::size_t>(along) * static_cast<std::size_t>(points_through);
      s.x.reserve(n);
      for (int j = 0; j < points_through; ++j) {
        for (int i = 0; i < along; ++i) {
          s.x.emplace_back(piece.x0_mm + (i + 0.5) * s.spacing[0], y0 + (j + 0.5) * s.spacing[1]);
        }
      }
      s.v.assign(n, Vec<2>::Zero());
      s.F.assign(n, Tensor<2>::Identity());
      s.stress.assign(n, Voigt::Zero());
      s.plastic.assign(n, 0.0);
      panel.strands.push_back(std::move(s));
    }
  }
  return panel;
}

std::vector<Vec<2>> corners(const Strand<2>& strand) {
  const int nx = strand.points[0], ny = strand.points[1];
  const auto corner = [nx](int i, int j) { return static_cast<std::size_t>(j) * (nx + 1) + i; };
  std::vector<Vec<2>> sum(static_cast<std::size_t>(nx + 1) * (ny + 1), Vec<2>::Zero());
  std::vector<int> count(sum.size(), 0);
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const auto p = static_cast<std::size_t>(j) * nx + i;
      for (int cj = 0; cj < 2; ++cj) {
        for (int ci = 0; ci < 2; ++ci) {
          const Vec<2> half((ci - 0.5) * strand.spacing[0], (cj - 0.5) * strand.spacing[1]);
          sum[corner(i + ci, j + cj)] += strand.x[p] + strand.F[p] * half;
          ++count[corner(i + ci, j + cj)];
        }
      }
    }
  }
  for (std::size_t c = 0; c < sum.size(); ++c) sum[c] /= count[c];
  return sum;
}

}  // namespace strandlab
