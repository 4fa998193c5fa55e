// Global stiffness of a meshed panel: the wood is summed once, the glue lines again for each glue stiffness.
#pragma once

#include <utility>
#include <vector>

#include "strandlab/statics/cholesky.hpp"
#include "strandlab/statics/springs.hpp"

namespace strandlab::statics {

template <int Dim>
class PanelStiffness {
 public:
  // Sums the elements and finds the place of every spring. Throws RunError for an inverted element.
  PanelStiffness(const Mesh<Dim>& mesh, std::vector<Spring<Dim>> springs);

  // Stiffness of wood and glue, no supports. The pattern is the same for every glue.
  LowerMatrix with(const glue::BondStiffness& glue) const;

  const std::vector<Spring<Dim>>& springs() const { return springs_; }
  // Jumps (tangential, then normal), mm, of every spring.
  std::vector<Vec<Dim>> jumps(const std::vector<double>& displacement) const;
  // Adds the nodal forces (N, 2D: per mm of depth) that hold the springs at these tractions (MPa, as the jumps).
  void add_traction_forces(const std::vector<Vec<Dim>>& tractions, std::vector<double>& force) const;

  // Strain energy (mJ, 2D: per mm of depth) of the wood, and of the glue lines, for displacements of all dofs (mm).
  double wood_energy(const std::vector<double>& displacement) const;
  double glue_energy(const std::vector<double>& displacement, const glue::BondStiffness& glue) const;
  // Work of given tractions on the jumps, mJ, 2D: per mm of depth.
  double traction_work(const std::vector<Vec<Dim>>& tractions, const std::vector<double>& displacement) const;

 private:
  using Nodes = std::array<int, kCorners<Dim>>;  // of an element or a spring
  void make_pattern(const Mesh<Dim>& mesh);
  int block_start(int row_node, int column_node, int component) const;
  void add_block(const Nodes& nodes, const ElementStiffness<Dim>& stiffness, std::vector<double>& values) const;

  std::vector<Nodes> elements_;
  std::vector<ElementStiffness<Dim>> element_stiffness_;
  std::vector<Spring<Dim>> springs_;
  std::vector<int> node_start_, node_row_;  // lower pattern of nodes: rows of a column, the column itself first
  LowerMatrix wood_;                        // value: wood alone
};

// Supports: dofs whose displacement is given. Rows and columns of such dofs are replaced by a diagonal, which keeps the
// pattern.
struct Supports {
  std::vector<char> fixed;  // by dof
  double diagonal = 1;      // N/mm, of the size of the other diagonal terms
};
LowerMatrix constrained(const LowerMatrix& stiffness, const Supports& supports);

// Right-hand side of constrained() for the forces (N) on free dofs and the displacements (mm) of fixed ones.
std::vector<double> right_hand_side(const LowerMatrix& stiffness, const Supports& supports,
                                    const std::vector<double>& force, const std::vector<double>& displacement);

}  // namespace strandlab::statics
