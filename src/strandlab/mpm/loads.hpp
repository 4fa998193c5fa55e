// What acts on the bodies from outside. A step asks every load twice: before the grid moves for its forces, after it
// for its work. A further load is a class with these two functions and its name in the list.
#pragma once

#include <tuple>
#include <vector>

#include "strandlab/mpm/gravity.hpp"
#include "strandlab/mpm/springs.hpp"
#include "strandlab/mpm/tractions.hpp"

namespace strandlab::mpm {

template <int Dim>
using Loads = std::tuple<Gravity<Dim>, Tractions<Dim>, Springs<Dim>>;

// Adds the forces of all loads to the records of nodes: after scatter, before rollers fold.
template <int Dim>
void apply(const Loads<Dim>& loads, const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step, Fields& fields) {
  std::apply([&](const auto&... load) { (load.apply(bodies, step, fields), ...); }, loads);
}

// After the grid update, which has the displacements that the forces are conjugate to: adds the work of the step to
// `work`, mJ, and lets loads that depend on displacements follow them. Springs keep theirs: Springs::energy().
template <int Dim>
void book(Loads<Dim>& loads, const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step, const Fields& fields,
          double& work) {
  std::apply([&](auto&... load) { (load.book(bodies, step, fields, work), ...); }, loads);
}

}  // namespace strandlab::mpm
