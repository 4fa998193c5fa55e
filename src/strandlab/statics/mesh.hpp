// Finite elements of a panel: each strand's corner lattice, resampled to the wanted number of elements through it.
#pragma once

#include <array>
#include <vector>

#include "strandlab/glue/glue.hpp"
#include "strandlab/panel/panel.hpp"
#include "strandlab/statics/element.hpp"

namespace strandlab::statics {

// Elements of one strand: a lattice of their own, evenly spaced in the strand as formed. Its corners are the nodes from
// first_node on, its cells the elements from first_element on.
template <int Dim>
struct StrandMesh {
  int strand = 0;  // index in the panel
  Lattice<Dim> elements;
  int first_node = 0, first_element = 0;
  Vec<Dim> points_per_element = Vec<Dim>::Zero();  // material points per element, by axis
  int along() const { return elements.counts[0]; }
  int through() const { return elements.counts[Dim - 1]; }
  template <class... Place>
  int node(Place... place) const {
    return first_node + static_cast<int>(elements.corner({place...}));
  }
};

template <int Dim>
struct Mesh {
  std::vector<StrandMesh<Dim>> strands;
  std::vector<int> mesh_of_strand;                       // by strand of the panel, -1 where it has no elements
  std::vector<Vec<Dim>> nodes;                           // mm
  std::vector<std::array<int, kCorners<Dim>>> elements;  // nodes, as ElementCorners
  std::vector<WoodStiffness<Dim>>
      stiffness;         // MPa, by element, panel axes: C0 V0/V_e with the axes of the element's points
  int straightened = 0;  // elements that were folded, as dragged strand corners are
  int dofs() const { return Dim * static_cast<int>(nodes.size()); }
  ElementCorners<Dim> corners(std::size_t element) const {
    ElementCorners<Dim> x;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = nodes[static_cast<std::size_t>(elements[element][i])];
    return x;
  }
};

// Length along the strand, as formed, that elements are given: that of a cube-shaped element, formed thickness of the
// thinnest strand / elements.
double element_length(const Panel<2>& panel, int elements_through);

// Mesh of the strands for which keep[strand] holds: `elements_through` elements through the thinnest strand, in others
// as many as keep their height nearest to that, each about `element_length` mm long [and wide] as formed. Strand ends
// and faces stay where the corner lattice puts them. Throws RunError for an inverted element.
Mesh<2> make_mesh(const Panel<2>& panel, const std::vector<bool>& keep, int elements_through);
Mesh<3> make_mesh(const Panel<3>& panel, const std::vector<bool>& keep, int elements_through, double element_length);

// Where a glue point lies on the mesh: its displacement is (1 - xi) u[first] + xi u[second].
struct FaceNodes {
  int first = 0, second = 0;  // nodes
  double xi = 0;
  int inward = 0;  // from a node of the face to the one below it in the strand
};
FaceNodes locate(const Mesh<2>& mesh, const glue::FacePoint<2>& point);

// The same on a panel: between the four nodes of an element's face, counter-clockwise in the strand's axes along and
// across; by the weights N = (1 + s_i xi)(1 + t_i eta)/4 of `place` = (xi, eta), each from -1 to 1.
struct FacetNodes {
  std::array<int, 4> nodes{};
  Vec<2> place = Vec<2>::Zero();
};
FacetNodes locate(const Mesh<3>& mesh, const glue::FacePoint<3>& point);

}  // namespace strandlab::statics
