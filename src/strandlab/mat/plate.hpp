// The mat of a plate (3D): layers of whole rectangular strands that lie in a window, before pressing, and its file.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/mat/rectangle.hpp"

namespace strandlab::mat {

// Strands of a layer may overlap by so much, less than any cell or element of a panel sees: those that touch may, by
// what the raster of the file makes of them, and those of mats that other programs formed with some tolerance.
inline constexpr double kMayOverlap_mm = 0.03;

// A strand as a whole: where the window is periodic it may reach over an edge, and its centre may lie anywhere.
struct PlateStrand {
  double cx_mm = 0, cy_mm = 0;          // centre
  double length_mm = 0, width_mm = 0;   // along the grain and across
  std::optional<double> angle_deg;      // of its length and grain, counter-clockwise from x; else that of its kind
  std::optional<std::string> material;  // else that of its kind
  std::string extra;                    // unknown keys, kept: text of a JSON object, or empty
};

struct PlateLayer {
  std::string role;                  // name of a strand kind
  std::vector<PlateStrand> strands;  // as placed
  std::string extra;
  std::optional<double> thickness_mm = {};  // of all its strands; else the mat's layer_thickness_mm
};

// Edges of the window: it repeats in x and y for ever (a torus), or strands end at it.
enum class PlateSides { kPeriodic, kCut };
// How strands lie upon each other: in flat layers of strands that do not overlap, or each on all that were laid before,
// in the order of the file, with limited slopes.
enum class Stack { kLayers, kDraped };
// Their names in files and cases, in the order of their values.
const std::vector<std::string>& plate_side_names();  // "periodic", "cut"
const std::vector<std::string>& stack_names();       // "layers", "draped"

struct PlateMat {
  double length_mm = 0, width_mm = 0;  // window along x and y
  double layer_thickness_mm = 0;       // of layers without a thickness of their own
  PlateSides sides = PlateSides::kPeriodic;
  Stack stack = Stack::kLayers;
  std::array<double, 2> drape_slopes{0.1, 0.2};  // along and across a strand; of draped mats
  std::vector<PlateLayer> layers;                // bottom to top; of draped mats: in the order of laying
  std::string extra;

  Window window() const { return {length_mm, width_mm, sides == PlateSides::kPeriodic}; }
  double thickness_of(std::size_t layer) const;  // mm
  // Of a mat in layers: mm, the thickness of all layers below this one; of all layers.
  double height_below(std::size_t layer) const;
  double thickness_mm() const { return height_below(layers.size()); }
};

// A strand kind as a mat needs it: what a layer's role may name, and the angle of strands that have none.
struct RoleAngle {
  std::string role;
  double angle_deg = 0;
};

// Angle of a strand in a layer of that role, which must be among `roles`.
double angle_deg(const PlateStrand& strand, const std::string& role, const std::vector<RoleAngle>& roles);
// The strand's outline in plan.
Rectangle outline(const PlateStrand& strand, double angle_deg);

// Number of dimensions of the mat in a file: 3 where its "dim" is 3, else 2. Throws InputError for a file that is no
// JSON, and for another "dim".
int dimensions(const std::filesystem::path& file);

// Reads a plate's mat file: coordinates are rounded to 1e-6 mm and angles to 1e-6 degree (a mat read back from its own
// file is the same to the last bit), strands keep their order. Throws InputError (file, layer, strand, counted from 1,
// what is wrong) for anything that is not a valid mat, a section mat among them.
PlateMat read_plate(const std::filesystem::path& file, const std::vector<RoleAngle>& roles);
// The same checks on a mat in memory; `source` opens the message. Strands of a layer overlap each other and their own
// images by kMayOverlap_mm at most; strands of draped mats lie on others, but not on their own images. Those of a cut
// mat lie along x or y within the window.
void validate(const PlateMat& mat, const std::vector<RoleAngle>& roles, const std::string& source);
// Text of a valid mat's file: coordinates to 1e-6 mm, angles to 1e-6 degree, the same bytes on every machine.
std::string to_text(const PlateMat& mat);
// Writes to_text() whole or not at all. Throws InputError for a mat that read_plate() would not take, and when the file
// cannot be written.
void write(const PlateMat& mat, const std::vector<RoleAngle>& roles, const std::filesystem::path& file);

}  // namespace strandlab::mat
