// Tractions on the faces of bodies, as forces on their nodes.
#pragma once

#include <vector>

#include "strandlab/mpm/fields.hpp"

namespace strandlab::mpm {

template <int Dim>
class Tractions {
 public:
  Tractions() = default;
  explicit Tractions(const std::vector<Body<Dim>>& bodies);  // those of the bodies' faces

  void set(std::size_t body, std::size_t face, const Vec<Dim>& traction);  // MPa
  void apply(const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step, Fields& fields) const;
  void book(const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step, const Fields& fields, double& work) const;

 private:
  template <class Visit>
  void each_node_under(const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step, const Fields& fields,
                       Visit visit) const;

  std::vector<double> tractions_;  // MPa, Dim for each of kMaxFaces faces of each body
  bool any_ = false;
};

}  // namespace strandlab::mpm
