// Finite elements of a panel: each strand's corner lattice, resampled to the wanted number of elements through it.
#pragma once

#include <array>
#include <vector>

#include "strandlab/glue/glue.hpp"
#include "strandlab/panel/panel.hpp"
#include "strandlab/statics/element.hpp"

namespace strandlab::statics {

// Elements of one strand: along x through of them, evenly spaced in the strand as formed. Corner (i, j) is node
// first_node + i + (along + 1) j; element (i, j) is first_element + i + along j.
struct StrandMesh {
  int strand = 0;  // index in the panel
  int along = 0, through = 0;
  int first_node = 0, first_element = 0;
  double points_per_element = 0;  // material points per element along the strand
  int node(int i, int j) const { return first_node + i + (along + 1) * j; }
};

struct Mesh {
  std::vector<StrandMesh> strands;
  std::vector<int> mesh_of_strand;           // by strand of the panel, -1 where it has no elements
  std::vector<Vec<2>> nodes;                 // mm
  std::vector<std::array<int, 4>> elements;  // nodes, counter-clockwise
  std::vector<PlaneStiffness>
      stiffness;         // MPa, by element, panel axes: C0 V0/V_e with the grain of the element's points
  int straightened = 0;  // elements that were folded, as dragged strand corners are
  int dofs() const { return 2 * static_cast<int>(nodes.size()); }
};

// Length along the strand, as formed, that elements are given: that of a cube-shaped element, formed thickness of the
// thinnest strand / elements.
double element_length(const Panel<2>& panel, int elements_through);

// Mesh of the strands for which keep[strand] holds: `elements_through` elements through the thinnest strand, in others
// as many as keep their height nearest to that. Strand ends and faces stay where the corner lattice puts them.
// Throws RunError for an inverted element.
Mesh make_mesh(const Panel<2>& panel, const std::vector<bool>& keep, int elements_through);

// Where a glue point lies on the mesh: its displacement is (1 - xi) u[first] + xi u[second].
struct FaceNodes {
  int first = 0, second = 0;  // nodes
  double xi = 0;
  int inward = 0;  // from a node of the face to the one below it in the strand
};
FaceNodes locate(const Mesh& mesh, const glue::FacePoint<2>& point);

}  // namespace strandlab::statics
