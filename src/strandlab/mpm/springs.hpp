// Springs between points of two bodies, as forces on the nodes that stretch with the nodes' motion.
#pragma once

#include <vector>

#include "strandlab/mpm/fields.hpp"
#include "strandlab/mpm/spring.hpp"

namespace strandlab::mpm {

template <int Dim>
class Springs {
 public:
  // As Engine::set_springs.
  void set(const std::vector<Spring<Dim>>& springs, const std::vector<Particles<Dim>>& bodies);
  void apply(const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step, Fields& fields) const;
  // They stretch, and keep their work as energy().
  void book(const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step, const Fields& fields, double& work);
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
