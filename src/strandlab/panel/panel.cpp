#include "strandlab/panel/panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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

// The material that a strand names, else its kind's. where() opens the message.
template <class Where>
const wood::Material& material_of(const StrandKind& kind, const std::optional<std::string>& given,
                                  const std::vector<StrandKind>& kinds, const Where& where) {
  if (!given || *given == kind.material.name) return kind.material;
  for (const auto& other : kinds) {
    if (other.material.name == *given) return other.material;
  }
  for (const auto& built_in : wood::library()) {
    if (built_in.name == *given) return built_in;
  }
  const auto names = material_names(kinds);
  throw InputError(fmt::format("{}: unknown material \"{}\"{} Materials: {}", where(), shortened(*given),
                               did_you_mean(*given, names), quoted_list(names)));
}

// The wood of a strand of a kind, its grain at an angle to the lattice.
wood::StrandMaterial wood_of(const StrandKind& kind, const wood::Material& material, double angle_deg) {
  auto wood = wood::softened(material, kind.yield_factor);
  wood.law = kind.material.law;
  return wood::in_strand_axes(wood, angle_deg, kind.off_axis);
}

// What a formed strand has of its kind and its place in the mat.
template <int Dim>
void describe(const StrandKind& kind, std::size_t row, double angle_deg, Strand<Dim>& strand) {
  strand.kind = kind.name;
  strand.row = static_cast<int>(row);
  strand.angle_deg = angle_deg;
  strand.stiffness_factor = kind.stiffness_factor;
}

struct Weighed {
  double volume;  // mm^3 (2D: mm^2)
  const wood::Material& material;
};

// Weight of the strands of a mat over an area of the panel (2D: a length); weigh_strand(strand, kind, row) says what
// one is.
template <class Mat, class WeighStrand>
Weight weighed(const Mat& mat, const std::vector<StrandKind>& kinds, double area, const WeighStrand& weigh_strand) {
  Weight weight;
  double total = 0;  // kg/m^3 mm^3 (2D: mm^2)
  const auto add = [](std::vector<WeightShare>& shares, const std::string& name, double mass) {
    auto share = std::find_if(shares.begin(), shares.end(), [&](const auto& s) { return s.name == name; });
    if (share == shares.end()) share = shares.insert(shares.end(), {name, 0});
    share->fraction += mass;
  };
  for (std::size_t row = 0; row < mat.layers.size(); ++row) {
    const auto& kind = find_kind(kinds, mat.layers[row].role, row);
    for (const auto& piece : mat.layers[row].strands) {
      const auto [volume, material] = weigh_strand(piece, kind, row);
      const double mass = volume * material.density_kg_m3;
      add(weight.by_kind, kind.name, mass);
      add(weight.by_material, material.name, mass);
      total += mass;
    }
  }
  for (auto* shares : {&weight.by_kind, &weight.by_material}) {
    for (auto& share : *shares) share.fraction /= total;
  }
  weight.kg_per_m2 = 1e-3 * total / area;
  return weight;
}

// A coordinate of a plate's strand, moved by whole periods into the window that repeats.
double in_window(double at_mm, double period_mm, bool periodic) {
  return periodic ? at_mm - period_mm * std::floor(at_mm / period_mm) : at_mm;
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
  return material_of(kind, strand.material, kinds,
                     [&] { return fmt::format("layer {}, strand at x = {} mm", layer + 1, strand.x0_mm); });
}

const wood::Material& find_material(const StrandKind& kind, const mat::PlateStrand& strand,
                                    const std::vector<StrandKind>& kinds, std::size_t layer, std::size_t number) {
  return material_of(kind, strand.material, kinds,
                     [&] { return fmt::format("layer {}, strand {}", layer + 1, number + 1); });
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
      const double angle = piece.angle_deg.value_or(kind.angle_deg);
      const double length = piece.x1_mm - piece.x0_mm;
      const int along = std::max(1, static_cast<int>(std::lround(length / spacing_along_mm)));
      const Lattice<2> lattice{{along, through}, {length / along, thickness / through}};
      const auto wood = wood_of(kind, find_material(kind, piece, kinds, row), angle);
      auto s = formed_strand<2>(lattice, {{piece.x0_mm, y0}}, wood);
      describe(kind, row, angle, s);
      panel.strands.push_back(std::move(s));
    }
  }
  return panel;
}

Panel<3> make_panel(const mat::PlateMat& mat, const std::vector<StrandKind>& kinds, double spacing_mm,
                    int points_through) {
  if (mat.stack == mat::Stack::kDraped)
    throw InputError("a panel can be made of mats in layers only: this one is draped");
  Panel<3> panel;
  panel.length_mm = mat.length_mm;
  panel.depth_mm = mat.width_mm;
  panel.periodic = mat.sides == mat::PlateSides::kPeriodic;
  panel.initial_thickness_mm = mat.thickness_mm();
  panel.top_mm = panel.initial_thickness_mm;
  double thinnest = std::numeric_limits<double>::max();
  for (std::size_t row = 0; row < mat.layers.size(); ++row) thinnest = std::min(thinnest, mat.thickness_of(row));
  for (std::size_t row = 0; row < mat.layers.size(); ++row) {
    const auto& kind = find_kind(kinds, mat.layers[row].role, row);
    const double thickness = mat.thickness_of(row), middle = mat.height_below(row) + 0.5 * thickness;
    const int through = mat::through(thickness, thinnest, points_through);
    for (std::size_t n = 0; n < mat.layers[row].strands.size(); ++n) {
      const auto& piece = mat.layers[row].strands[n];
      const double angle = piece.angle_deg.value_or(kind.angle_deg);
      const int along = divisions(piece.length_mm, spacing_mm), across = divisions(piece.width_mm, spacing_mm);
      const Lattice<3> lattice{{along, across, through},
                               {piece.length_mm / along, piece.width_mm / across, thickness / through}};
      const auto wood =
          wood_of(kind, find_material(kind, piece, kinds, row, n), 0);  // the lattice is turned, not the wood
      const Vec<3> centre{in_window(piece.cx_mm, panel.length_mm, panel.periodic),
                          in_window(piece.cy_mm, panel.depth_mm, panel.periodic), middle};
      auto s = formed_strand<3>(lattice, turned(lattice, centre, angle), wood);
      describe(kind, row, angle, s);
      panel.strands.push_back(std::move(s));
    }
  }
  return panel;
}

Weight weigh(const mat::Mat& mat, const std::vector<StrandKind>& kinds) {
  return weighed(mat, kinds, mat.length_mm, [&](const mat::Strand& piece, const StrandKind& kind, std::size_t row) {
    return Weighed{(piece.x1_mm - piece.x0_mm) * mat.thickness_of(row), find_material(kind, piece, kinds, row)};
  });
}

Weight weigh(const mat::PlateMat& mat, const std::vector<StrandKind>& kinds) {
  const double window = mat.length_mm * mat.width_mm;
  return weighed(mat, kinds, window, [&](const mat::PlateStrand& piece, const StrandKind& kind, std::size_t row) {
    const auto number = static_cast<std::size_t>(&piece - mat.layers[row].strands.data());
    return Weighed{piece.length_mm * piece.width_mm * mat.thickness_of(row),
                   find_material(kind, piece, kinds, row, number)};
  });
}

}  // namespace strandlab
