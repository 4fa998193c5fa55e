// Elements that pressing has folded, made fit for a test.
#pragma once

#include <vector>

#include "strandlab/statics/mesh.hpp"

namespace strandlab::statics {

// Moves the nodes of folded elements of one strand, and of a growing neighbourhood, to the mean of their neighbours
// until no corner of an element has less than a tenth of its measure as formed (mm^2, in 3D mm^3). Nodes of a face stay
// a face, those of an edge an edge. Returns the number of elements that were folded. Throws RunError when some still
// are.
template <int Dim>
int straighten(const StrandMesh<Dim>& part, double formed_measure, std::vector<Vec<Dim>>& nodes);

}  // namespace strandlab::statics
