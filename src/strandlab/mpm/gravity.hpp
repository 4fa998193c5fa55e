// Gravity, as forces on the nodes of bodies.
#pragma once

#include <vector>

#include "strandlab/mpm/fields.hpp"

namespace strandlab::mpm {

template <int Dim>
class Gravity {
 public:
  void set(const Vec<Dim>& g) { g_ = g; }  // mm/s^2
  void apply(const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step, Fields& fields) const;
  void book(const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step, const Fields& fields, double& work);

 private:
  Vec<Dim> g_ = Vec<Dim>::Zero();
};

}  // namespace strandlab::mpm
