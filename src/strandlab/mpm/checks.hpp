// What must hold of the grid and the particles, and what is said when it does not.
#pragma once

#include <string>
#include <vector>

#include "strandlab/core/error.hpp"
#include "strandlab/mpm/engine.hpp"
#include "strandlab/mpm/particles.hpp"

namespace strandlab::mpm {

std::string moment(const EngineState& state);  // "step 12, time 0.034 ms"
template <int Dim>
std::string text(const Vec<Dim>& x);  // "1.0000, 2.0000 mm"

// Throws InputError for cells that are not positive, an empty window, or rollers off the grid lines.
template <int Dim>
void check_grid(const Grid<Dim>& grid);

// Throws RunError for a particle behind a roller by more than a quarter cell, or outside a free side or a platen by
// more than the window is wide and two cells: no strand is longer, and one that a free side lets go is not lost.
template <int Dim>
void check_inside(const std::vector<Particles<Dim>>& bodies, const Grid<Dim>& grid, const EngineState& state);

// Names the particle of a block that inverted, else the one whose stress is not finite.
template <int Dim>
RunError particle_failure(const Particles<Dim>& body, int block, const EngineState& state);

}  // namespace strandlab::mpm
