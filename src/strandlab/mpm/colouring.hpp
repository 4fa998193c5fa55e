// What lets tiles scatter at the same time without locks: those of one colour share no node.
#pragma once

#include <vector>

#include "strandlab/mpm/engine.hpp"
#include "strandlab/mpm/particles.hpp"
#include "strandlab/mpm/tiles.hpp"

namespace strandlab::mpm {

// Throws RunError naming the body and a place where two tiles of one colour reach the same node, now or before the
// patches are laid again: by a particle, by its mirror image in a platen or by a face point.
template <int Dim>
void check_colouring(const TilePlan& plan, const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step,
                     const EngineState& state);

}  // namespace strandlab::mpm
