#include "strandlab/panel/panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/core/nearest.hpp"
#include "strandlab/core/text.hpp"

namespace strandlab {
namespace {

std::string did_you_mean(const std::string& given, const std::vector<std::string>& known) {
  const auto near = nearest(given, known);
  return near.empty() ? "." : fmt::format("; did you mean \"{}\"?", near);
}

std::vector<std::string> material_names(const std::vector<StrandKind>& kinds) {
  std::vector<std::string> names;
  for (const auto& built_in : wood::library()) names.push_back(built_in.name);
  for (const auto& kind : kinds) {
    if (std::find(names.begin(), names.end(), kind.material.name) == names.end()) names.push_back(kind.material.name);
  }
  return names;
}

}  // namespace

const StrandKind& find_kind(const std::vector<StrandKind>& kinds, const std::string& role, std::size_t layer) {
  for (const auto& kind : kinds) {
    if (kind.name == role) return kind;
  }
  std::vector<std::string> names(kinds.size());
  std::transform(kinds.begin(), kinds.end(), names.begin(), [](const auto& kind) { return kind.name; });
  throw InputError(fmt::format("layer {}: role \"{}\" is not a strand kind of the case{} Strand kinds: {}", layer + 1,
                               role, did_you_mean(role, names), quoted_list(names)));
}

const wood::Material& find_material(const StrandKind& kind, const mat::Strand& strand,
                                    const std::vector<StrandKind>& kinds, std::size_t layer) {
  if (!strand.material || *strand.material == kind.material.name) return kind.material;
  for (const auto& other : kinds) {
    if (other.material.name == *strand.material) return other.material;
  }
  for (const auto& built_in : wood::library()) {
    if (built_in.name == *strand.material) return built_in;
  }
  const auto names = material_names(kinds);
  throw InputError(fmt::format("layer {}, strand at x = {} mm: unknown material \"{}\"{} Materials: {}", layer + 1,
                               strand.x0_mm, shortened(*strand.material), did_you_mean(*strand.material, names),
                               quoted_list(names)));
}

Panel<2> make_panel(const mat::Mat& mat, const std::vector<StrandKind>& kinds, double spacing_along_mm,
                    int points_through) {
  Panel<2> panel;
  panel.length_mm = mat.length_mm;
  panel.initial_thickness_mm = mat.thickness_mm();
  panel.top_mm = panel.initial_thickness_mm;
  const double thinnest = mat.layers.empty() ? 0 : mat::thinnest_layer(mat);
  for (std::size_t row = 0; row < mat.layers.size(); ++row) {
    const auto& kind = find_kind(kinds, mat.layers[row].role, row);
    const double thickness = mat.thickness_of(row), y0 = mat.height_below(row);
    const int through = mat::through(thickness, thinnest, points_through);
    for (const auto& piece : mat.layers[row].strands) {
      Strand<2> s;
      s.kind = kind.name;
      s.row = static_cast<int>(row);
      s.angle_deg = piece.angle_deg.value_or(kind.angle_deg);
      auto wood = wood::softened(find_material(kind, piece, kinds, row), kind.yield_factor);
      wood.law = kind.material.law;
      s.material = wood::in_strand_axes(wood, s.angle_deg, kind.off_axis);
      s.stiffness_factor = kind.stiffness_factor;
      const double length = piece.x1_mm - piece.x0_mm;
      const int along = std::max(1, static_cast<int>(std::lround(length / spacing_along_mm)));
      s.points = {along, through};
      s.spacing = {length / along, thickness / through};
      const std::size_t n = static_cast<std::size_t>(along) * static_cast<std::size_t>(through);
      s.x.reserve(n);
      for (int j = 0; j < through; ++j) {
        for (int i = 0; i < along; ++i) {
          s.x.emplace_back(piece.x0_mm + (i + 0.5) * s.spacing[0], y0 + (j + 0.5) * s.spacing[1]);
        }
      }
      s.v.assign(n, Vec<2>::Zero());
      s.F.assign(n, Tensor<2>::Identity());
      s.stress.assign(n, Voigt::Zero());
      s.plastic.assign(n, s.material.crushing.start);
      panel.strands.push_back(std::move(s));
    }
  }
  return panel;
}

Weight weigh(const mat::Mat& mat, const std::vector<StrandKind>& kinds) {
  Weight weight;
  double total = 0;  // kg/m^3 mm^2
  const auto add = [](std::vector<WeightShare>& shares, const std::string& name, double mass) {
    auto share = std::find_if(shares.begin(), shares.end(), [&](const auto& s) { return s.name == name; });
    if (share == shares.end()) share = shares.insert(shares.end(), {name, 0});
    share->fraction += mass;
  };
  for (std::size_t row = 0; row < mat.layers.size(); ++row) {
    const auto& kind = find_kind(kinds, mat.layers[row].role, row);
    for (const auto& piece : mat.layers[row].strands) {
      const auto& material = find_material(kind, piece, kinds, row);
      const double mass = (piece.x1_mm - piece.x0_mm) * mat.thickness_of(row) * material.density_kg_m3;
      add(weight.by_kind, kind.name, mass);
      add(weight.by_material, material.name, mass);
      total += mass;
    }
  }
  for (auto* shares : {&weight.by_kind, &weight.by_material}) {
    for (auto& share : *shares) share.fraction /= total;
  }
  weight.kg_per_m2 = 1e-3 * total / mat.length_mm;
  return weight;
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
