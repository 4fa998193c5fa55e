// What the engine is given: bodies of particles with faces, by which they touch others.
#pragma once

#include <string>
#include <vector>

#include "strandlab/panel/panel.hpp"

namespace strandlab::mpm {

// Part of a body's surface whose normals do not cancel: top, bottom, one end... A face point rides on a particle p: it
// is at x_p + F_p offset, with outward area vector cof(F_p) area. Faces are kept apart because the top and the bottom
// of a compacted strand reach the same node.
template <int Dim>
struct Face {
  std::string name;
  std::vector<int> particle;
  std::vector<Vec<Dim>> offset;          // mm, at formation
  std::vector<Vec<Dim>> area;            // mm (2D, per mm depth) or mm^2, outward, at formation
  Vec<Dim> traction = Vec<Dim>::Zero();  // MPa, applied to the face (dead load on the area at formation)
};

// A deformable body: particles plus surface points.
template <int Dim>
struct Body {
  std::string name;
  wood::StrandMaterial material;
  Lattice<Dim> lattice;  // of the particles; its spacing is a particle's domain at formation. No counts: any order
  Points<Dim> points;    // the particles' state
  std::vector<Face<Dim>> faces;
};

// The body of a strand: its lattice and its faces (top and bottom, the two ends, in 3D the two edges).
template <int Dim>
Body<Dim> body_of(const Strand<Dim>& strand);

}  // namespace strandlab::mpm
