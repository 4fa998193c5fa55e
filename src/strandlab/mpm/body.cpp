#include "strandlab/mpm/body.hpp"

namespace strandlab::mpm {
namespace {

// A face of a lattice, its points on the outer ends of the particles' cells.
template <int Dim>
Face<Dim> surface(const Lattice<Dim>& lattice, const LatticeFace& at) {
  Face<Dim> face;
  face.name = at.name;
  Vec<Dim> offset = Vec<Dim>::Zero(), area = Vec<Dim>::Zero();
  const double sign = at.end == 0 ? -1 : 1;
  offset[at.axis] = sign * 0.5 * lattice.spacing[at.axis];
  area[at.axis] = sign * lattice.point_volume() / lattice.spacing[at.axis];
  for (const auto p : lattice.face_points(at)) face.particle.push_back(static_cast<int>(p));
  face.offset.assign(face.particle.size(), offset);
  face.area.assign(face.particle.size(), area);
  return face;
}

}  // namespace

template <int Dim>
Body<Dim> body_of(const Strand<Dim>& strand) {
  Body<Dim> body;
  body.name = strand.kind + " strand in row " + std::to_string(strand.row + 1);
  body.material = strand.material;
  body.material.stiffness *= strand.stiffness_factor;
  body.lattice = strand.lattice;
  body.points = strand.points;
  for (const auto& face : lattice_faces<Dim>()) body.faces.push_back(surface(strand.lattice, face));
  return body;
}

template Body<2> body_of<2>(const Strand<2>&);
template Body<3> body_of<3>(const Strand<3>&);

}  // namespace strandlab::mpm
