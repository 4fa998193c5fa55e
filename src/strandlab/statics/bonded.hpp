// A panel glued together by one bond: its displacements under loads, with perfect bonds that open by nothing.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "strandlab/glue/bond.hpp"
#include "strandlab/statics/stiffness.hpp"

namespace strandlab::statics {

// Forces on the free dofs (N, 2D: per mm of depth) and displacements of the fixed ones (mm), each of all dofs.
struct LoadCase {
  std::vector<double> forces, given;
  bool operator==(const LoadCase&) const = default;
};

// Displacements, and the tractions that perfect bonds carry in excess of their penalty springs.
template <int Dim>
struct Solution {
  std::vector<double> displacement;  // mm
  std::vector<Vec<Dim>> excess;      // MPa, tangential, then normal, by spring
  void add(double factor, const Solution<Dim>& other);
};

// Wall time, s.
struct SolveTimes {
  double assemble = 0, analyse = 0, factor = 0, solve = 0;
};

// Penalty (MPa/mm) of a perfect bond: `times` the stiffness of the stiffest element, over the length of elements.
template <int Dim>
double penalty(const Mesh<Dim>& mesh, double element_length, double times);

template <int Dim>
class BondedPanel {
 public:
  // Sums the wood, once for all bonds. Throws RunError for an inverted element.
  BondedPanel(const Mesh<Dim>& mesh, std::vector<Spring<Dim>> springs, double penalty);

  // Glues the panel with this bond, in place of the one before; springs of less quality or resin with what it makes of
  // it. The
  // first time it also analyses the matrix, whose pattern is that of every bond. Throws OutOfMemory.
  void glue(const glue::Bond& bond, SolveTimes& times);

  // Stiffness of wood and glue without supports.
  const LowerMatrix& stiffness() const { return stiffness_; }

  // Solutions of load cases on the same supports, with one factorisation. `before_solve`, where given, is called before
  // each; what it throws passes through. Throws RunError where the supports leave a motion free, OutOfMemory.
  std::vector<Solution<Dim>> solve(const Supports& supports, const std::vector<LoadCase>& loads, SolveTimes& times,
                                   const std::function<void()>& before_solve = nullptr);

  // Of wood and glue lines, mJ, 2D: per mm of depth.
  double energy(const Solution<Dim>& s) const;
  // Nodal forces that hold the panel in this state: reactions and loads, N, 2D: per mm of depth.
  std::vector<double> forces(const Solution<Dim>& s) const;
  // Openings of the glue points (tangential, normal), mm.
  std::vector<Vec<Dim>> jumps(const Solution<Dim>& s) const { return parts_.jumps(s.displacement); }

 private:
  double hand_over(Solution<Dim>& s) const;
  std::vector<Solution<Dim>> respond(const LowerMatrix& matrix, const Supports& supports,
                                     const std::vector<std::vector<double>>& rhs);

  PanelStiffness<Dim> parts_;
  double penalty_;
  std::vector<glue::BondStiffness> bonds_;  // by spring
  LowerMatrix stiffness_;
  std::unique_ptr<Cholesky> cholesky_;
};

}  // namespace strandlab::statics
