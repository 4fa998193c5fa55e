// A mat: rows of strands before pressing, and the file it is kept in.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace strandlab::mat {

// A strand in a section is at least this long; a shorter piece of one that the edge of the window cuts off is left out.
// A body thinner than a few per cent of a grid cell has no use and no stable motion.
inline constexpr double kShortestPiece_mm = 0.01;

struct Strand {
  double x0_mm = 0, x1_mm = 0;
  std::optional<double> angle_deg;      // else that of the strand kind
  std::optional<std::string> material;  // else that of the strand kind
  std::string extra;                    // unknown keys, kept: text of a JSON object, or empty
};

struct Layer {
  std::string role;             // name of a strand kind
  std::vector<Strand> strands;  // by x0, not overlapping
  std::string extra;
  std::optional<double> thickness_mm = {};  // of all its strands; else the mat's layer_thickness_mm
};

// Section mat: layers bottom to top, without vertical gaps, in the window 0..length_mm.
struct Mat {
  double length_mm = 0;
  double layer_thickness_mm = 0;  // of layers without a thickness of their own
  std::vector<Layer> layers;
  std::string extra;

  double thickness_of(std::size_t layer) const;  // mm
  double height_below(std::size_t layer) const;  // mm, thickness of all layers below this one
  double thickness_mm() const { return height_below(layers.size()); }
};

// Thickness (mm) of the thinnest layer: what the resolution of a panel is measured by. Needs at least one layer.
double thinnest_layer(const Mat& mat);
// Points, cells or elements through a layer of `thickness_mm` when the thinnest one has `through_thinnest`: whole, and
// as near to the same size as possible.
int through(double thickness_mm, double thinnest_mm, int through_thinnest);

// Reads a mat file: coordinates are rounded to 1e-6 mm (a mat read back from its own file is the same to the last bit)
// and each layer's strands are sorted by x0. Throws InputError (file, layer, strand, what is wrong) for anything that
// is not a valid mat; `kinds` are the strand kinds a role may name (empty: any).
Mat read(const std::filesystem::path& file, const std::vector<std::string>& kinds);
// The same checks on a mat in memory; `source` opens the message.
void validate(const Mat& mat, const std::vector<std::string>& kinds, const std::string& source);
// Text of a valid mat's file: coordinates to 1e-6 mm, the same bytes on every machine.
std::string to_text(const Mat& mat);
// Writes to_text() whole or not at all. Throws InputError for a mat that read() would not take, and when the file
// cannot be written.
void write(const Mat& mat, const std::filesystem::path& file);

}  // namespace strandlab::mat
