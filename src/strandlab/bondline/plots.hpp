// Pictures of an analysis, as gnuplot programs.
#pragma once

#include <string>
#include <vector>

#include "strandlab/bondline/analysis.hpp"

namespace strandlab::bondline {

struct Picture {
  std::string file_name;  // "means.png"
  std::string script;     // gnuplot program that prints the PNG to its standard output
};

// mapping_<group>.png: the curve k(1/D_t) of the group's mean specimen with every specimen and its 95 % interval mapped
// on it; means.png: the mean 1/D_t of every group with its 95 % interval over the specimens' values. Groups without a
// value are left out.
std::vector<Picture> pictures(const Analysis& analysis);

}  // namespace strandlab::bondline
