// The same bond at every spring.
#pragma once

#include <vector>

#include "strandlab/statics/stiffness.hpp"

namespace strandlab::statics {

template <int Dim>
std::vector<glue::BondStiffness> everywhere(const PanelStiffness<Dim>& stiffness, const glue::BondStiffness& bond) {
  return std::vector<glue::BondStiffness>(stiffness.springs().size(), bond);
}

}  // namespace strandlab::statics
