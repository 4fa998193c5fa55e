#include "strandlab/mpm/engine.hpp"

namespace strandlab::mpm {
namespace {

// Adds the face of a lattice on which axis `normal` has its lowest (side 0) or highest (side 1) index.
template <int Dim>
Face<Dim> lattice_face(const Strand<Dim>& strand, int normal, int side, const std::string& name) {
  Face<Dim> face;
  face.name = name;
  Vec<Dim> offset = Vec<Dim>::Zero(), area = Vec<Dim>::Zero();
  const double sign = side == 0 ? -1 : 1;
  offset[normal] = sign * 0.5 * strand.spacing[normal];
  area[normal] = sign * strand.point_volume() / strand.spacing[normal];
  for (std::size_t p = 0; p < strand.size(); ++p) {
    std::array<int, Dim> index{};
    int rest = static_cast<int>(p);
    for (int a = 0; a < Dim; ++a) {
      index[a] = rest % strand.points[a];
      rest /= strand.points[a];
    }
    if (index[normal] != (side == 0 ? 0 : strand.points[normal] - 1)) continue;
    face.particle.push_back(static_cast<int>(p));
    face.offset.push_back(offset);
    face.area.push_back(area);
  }
  return face;
}

}  // namespace

template <int Dim>
Body<Dim> body_of(const Strand<Dim>& strand) {
  Body<Dim> body;
  body.name = strand.kind + " strand in row " + std::to_string(strand.row + 1);
  body.material = strand.material;
  body.material.stiffness *= strand.stiffness_factor;
  body.points = strand.points;
  body.spacing = strand.spacing;
  body.x = strand.x;
  body.v = strand.v;
  body.F = strand.F;
  body.stress = strand.stress;
  body.plastic = strand.plastic;
  static const char* const kNames[3][2] = {{"left end", "right end"}, {"near edge", "far edge"}, {"bottom", "top"}};
  for (int axis = Dim - 1; axis >= 0; --axis) {
    const int name = axis == Dim - 1 ? 2 : axis;
    for (int side = 0; side < 2; ++side) body.faces.push_back(lattice_face(strand, axis, side, kNames[name][side]));
  }
  return body;
}

template Body<2> body_of<2>(const Strand<2>&);
template Body<3> body_of<3>(const Strand<3>&);

}  // namespace strandlab::mpm
