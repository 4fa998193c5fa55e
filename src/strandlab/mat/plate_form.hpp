// Random forming of the mats of plates.
#pragma once

#include <cstdint>
#include <vector>

#include "strandlab/mat/plate_layup.hpp"
#include "strandlab/mat/sequential.hpp"

namespace strandlab::mat {

struct FormedPlate {
  PlateMat mat;                    // each strand names its angle
  std::vector<DrawnAngles> drawn;  // of each layer of the mat
};

// The mat of a layup. In layers: each row by random sequential addition (sequential.hpp); a cut mat is a window of a
// torus that is larger by two strand lengths. Draped: each block of rows of one kind is one layer of the mat, of as
// many strands as cover the window once for each of its rows, anywhere and at any of their angles; heights are found by
// drape.hpp. Throws InputError for a layup that check() refuses, and for a row of which no strand finds a place. The
// same seed gives the same mat, to the last bit of its file, on every machine: the stream of a layer is keyed by (seed,
// layer).
FormedPlate form(const PlateLayup& layup, std::uint64_t seed);

// Area of the layer's strands over that of the window.
double coverage(const PlateMat& mat, std::size_t layer);
// Mean |angle - mean_deg| (degrees) of the strands of a layer, each of which names its angle; deviations lie within 90
// degrees.
double mean_off(double mean_deg, const PlateLayer& layer);

}  // namespace strandlab::mat
