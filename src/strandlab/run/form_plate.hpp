// The mat of the case of a plate (3D), formed into a folder.
#pragma once

#include <string>
#include <vector>

#include "strandlab/case/plate_mat.hpp"
#include "strandlab/run/folder.hpp"

namespace strandlab::run {

// What is told of a formed mat: its layers with coverage and angles drawn and placed, its weight, and the height of a
// draped one.
std::vector<std::string> describe_plate(const cases::Case& c, const mat::FormedPlate& formed);

// Forms the mat of a case and leaves case.toml, mat.json, layers.csv and pictures/layer_NN.svg in the folder; returns
// describe_plate(). Throws InputError as cases::make_plate(), and, with nothing written, for a folder of other results,
// or of these without `force`.
std::vector<std::string> form_plate_mat(const cases::Case& c, const Place& place);

}  // namespace strandlab::run
