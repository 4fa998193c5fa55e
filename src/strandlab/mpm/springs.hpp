// Springs between points of two bodies: their forces on the nodes, and their stretch by the nodes' motion.
#pragma once

#include <vector>

#include "strandlab/mpm/fields.hpp"

namespace strandlab::mpm {

template <int Dim>
class Springs {
 public:
  // As Engine::set_springs.
  void set(const std::vector<Spring<Dim>>& springs, const std::vector<Particles<Dim>>& bodies);
  // Adds their forces to the records of nodes before the grid update.
  void apply(const std::vector<Particles<Dim>>& bodies, const Frame<Dim>& f, Fields& fields) const;
  // By the grid's displacements, to which their forces are conjugate: after the grid update.
  void stretch(const std::vector<Particles<Dim>>& bodies, const Frame<Dim>& f, const Fields& fields);
  double energy() const;  // mJ, stored now

 private:
  struct Stretched {
    Spring<Dim> spring;
    Vec<Dim> jump = Vec<Dim>::Zero();  // mm, [u]
  };
  static Vec<Dim> traction(const Stretched& s);  // MPa, on body a

  std::vector<Stretched> springs_;
};

}  // namespace strandlab::mpm
