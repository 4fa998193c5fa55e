// What the files of section mats and of plate mats have in common: the members of their JSON objects, read with one
// message for what is wrong, and how numbers and further keys are written. Of the room mat alone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "strandlab/mat/raster.hpp"

namespace strandlab::mat {

using Json = nlohmann::json;
using Keys = std::vector<std::string>;

inline constexpr double kLongestMat = 1e9;      // mm
inline constexpr double kThinnestLayer = 1e-3;  // mm

[[noreturn]] void reject(const std::string& where, const std::string& what);  // throws InputError
std::string at_layer(const std::string& source, std::size_t layer);           // counted from 0, shown from 1
std::string at_strand(const std::string& layer, std::size_t strand);

// A member that must be there, of a JSON object whose known keys are `known`: a misspelt one is named.
const Json& member(const Json& object, const char* key, const Keys& known, const std::string& where);
// A value that must be a number, a text, a list, an object.
double number(const Json& value, const char* key, const char* unit, const std::string& where);
std::string text(const Json& value, const char* key, const std::string& where);
const Json& list(const Json& value, const char* key, const std::string& where);
void require_object(const Json& value, const std::string& where);
// The members of an object besides the known ones, as text; keys in alphabetical order.
std::string others(const Json& object, const Keys& known);
// Number of dimensions of a mat: its "dim", 2 or 3; 2 where it has none.
int dimensions(const Json& mat, const std::string& source);

void check_thickness(const char* key, double thickness_mm, const std::string& where);
void check_role(const std::string& role, const Keys& kinds, const std::string& where);  // no kinds: any role

// A number on the raster with no more digits than it needs, but at least one decimal: 0.0, 91.73.
std::string coordinate(double value);
// Extra keys as further members of an object: the text within their braces after a separator.
std::string members(const std::string& extra, const char* separator);

// Thicknesses and heights (mm) of the layers of either kind of mat.
template <class AnyMat>
double thickness_of(const AnyMat& mat, std::size_t layer) {
  return mat.layers[layer].thickness_mm.value_or(mat.layer_thickness_mm);
}
// Layers that are alike are counted, not summed: twenty of .8 mm are 16 mm to the last bit.
template <class AnyMat>
double height_below(const AnyMat& mat, std::size_t layer) {
  double own = 0;
  std::size_t alike = 0;
  for (std::size_t i = 0; i < layer; ++i) {
    if (mat.layers[i].thickness_mm)
      own += *mat.layers[i].thickness_mm;
    else
      ++alike;
  }
  return own + mat.layer_thickness_mm * static_cast<double>(alike);
}
template <class AnyMat>
double thinnest(const AnyMat& mat) {
  double least = mat.thickness_of(0);
  for (std::size_t i = 1; i < mat.layers.size(); ++i) least = std::min(least, mat.thickness_of(i));
  return least;
}

}  // namespace strandlab::mat
