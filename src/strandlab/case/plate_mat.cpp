#include "strandlab/case/plate_mat.hpp"

#include <fmt/format.h>

#include <utility>

#include "strandlab/case/plate.hpp"
#include "strandlab/core/error.hpp"

namespace strandlab::cases {
mat::PlateLayup plate_layup(const Case& c) {
  auto layup = c.plate;
  layup.length_mm = c.length_mm;
  layup.layer_thickness_mm = c.layer_thickness_mm;
  for (const auto* kind : row_kinds(c)) {
    mat::PlateRow row{kind->name, kind->sizes, angles(c, *kind)};
    if (kind->thickness_mm > 0) row.thickness_mm = kind->thickness_mm;
    layup.rows.push_back(std::move(row));
  }
  return layup;
}

std::vector<mat::RoleAngle> role_angles(const Case& c) {
  std::vector<mat::RoleAngle> roles;
  for (const auto& kind : c.kinds) roles.push_back({kind.name, kind.angle_deg});
  return roles;
}

mat::FormedPlate make_plate(const Case& c) {
  if (!has_plate_mat(c))
    throw InputError(
        fmt::format("{}: the case of a section: mat.width_mm makes one of a plate (3D), whose mat "
                    "`strandlab form` makes; that of a section is made by `strandlab mat`",
                    c.name));
  if (c.mat_file.empty()) return mat::form(plate_layup(c), c.seed);
  try {
    return {mat::read_plate(c.mat_file, role_angles(c)), {}};
  } catch (const InputError& e) {
    throw InputError(c.places.mat_file.empty() ? e.what() : fmt::format("{}: {}", c.places.mat_file, e.what()));
  }
}

}  // namespace strandlab::cases
