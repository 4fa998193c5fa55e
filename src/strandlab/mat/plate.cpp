#include "strandlab/mat/plate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/files/json_text.hpp"
#include "strandlab/mat/file_format.hpp"
#include "strandlab/mat/mat.hpp"

namespace strandlab::mat {
namespace {

const Keys kPlateKeys{"dim", "length_mm", "width_mm", "layer_thickness_mm", "sides", "stack", "drape_slopes", "layers"};
const Keys kPlateLayerKeys{"role", "thickness_mm", "strands"};
const Keys kPlateStrandKeys{"cx", "cy", "length", "width", "angle_deg", "material"};

constexpr double kLargestAngle = 1e6;  // degrees: an angle keeps its six decimals
constexpr double kSteepest = 10;       // slope of a draped strand
// A strand is at most so many windows long, since the images that it could meet grow as the square of that, and its
// centre lies within so many windows.
constexpr double kMostWindows = 10;

// The place of a text in `names`.
std::size_t choice(const Json& value, const char* key, const Keys& names, const std::string& where) {
  const auto given = text(value, key, where);
  const auto found = std::find(names.begin(), names.end(), given);
  if (found == names.end()) {
    reject(where, fmt::format("{} = \"{}\" must be \"{}\" or \"{}\"", key, shortened(given), names[0], names[1]));
  }
  return static_cast<std::size_t>(found - names.begin());
}

PlateStrand plate_strand_from(const Json& json, const std::string& where) {
  require_object(json, where);
  const auto length = [&](const char* key) {
    return on_raster(number(member(json, key, kPlateStrandKeys, where), key, "mm", where));
  };
  PlateStrand strand;
  strand.cx_mm = length("cx");
  strand.cy_mm = length("cy");
  strand.length_mm = length("length");
  strand.width_mm = length("width");
  if (json.contains("angle_deg"))
    strand.angle_deg = on_raster(number(json["angle_deg"], "angle_deg", "degrees", where));
  if (json.contains("material")) strand.material = text(json["material"], "material", where);
  strand.extra = others(json, kPlateStrandKeys);
  return strand;
}

PlateLayer plate_layer_from(const Json& json, const std::string& where) {
  require_object(json, where);
  PlateLayer layer;
  layer.role = text(member(json, "role", kPlateLayerKeys, where), "role", where);
  if (json.contains("thickness_mm")) layer.thickness_mm = number(json["thickness_mm"], "thickness_mm", "mm", where);
  const Json& strands = list(member(json, "strands", kPlateLayerKeys, where), "strands", where);
  for (std::size_t i = 0; i < strands.size(); ++i) {
    layer.strands.push_back(plate_strand_from(strands[i], at_strand(where, i)));
  }
  layer.extra = others(json, kPlateLayerKeys);
  return layer;
}

std::array<double, 2> slopes_from(const Json& json, const std::string& where) {
  if (list(json, "drape_slopes", where).size() != 2) {
    reject(where, fmt::format("drape_slopes has {} numbers; it has two, along and across a strand", json.size()));
  }
  return {number(json[0], "drape_slopes", "slope", where), number(json[1], "drape_slopes", "slope", where)};
}

PlateMat plate_from(const Json& json, const std::string& source) {
  require_object(json, source);
  if (dimensions(json, source) != 3) {
    reject(source, "without \"dim\":3 this is a section mat (2D); here the mat of a plate is read, whose file has it");
  }
  const auto length = [&](const char* key) { return number(member(json, key, kPlateKeys, source), key, "mm", source); };
  PlateMat mat;
  mat.length_mm = on_raster(length("length_mm"));
  mat.width_mm = on_raster(length("width_mm"));
  mat.layer_thickness_mm = length("layer_thickness_mm");
  if (json.contains("sides"))
    mat.sides = static_cast<PlateSides>(choice(json["sides"], "sides", plate_side_names(), source));
  if (json.contains("stack")) mat.stack = static_cast<Stack>(choice(json["stack"], "stack", stack_names(), source));
  if (json.contains("drape_slopes")) {
    if (mat.stack != Stack::kDraped) reject(source, "drape_slopes belongs to a mat with \"stack\":\"draped\"");
    mat.drape_slopes = slopes_from(json["drape_slopes"], source);
  }
  const Json& layers = list(member(json, "layers", kPlateKeys, source), "layers", source);
  for (std::size_t i = 0; i < layers.size(); ++i)
    mat.layers.push_back(plate_layer_from(layers[i], at_layer(source, i)));
  mat.extra = others(json, kPlateKeys);
  return mat;
}

void check_size(const char* key, double mm, const std::string& where) {
  if (mm >= kShortestPiece_mm && mm <= kLongestMat) return;
  reject(where, fmt::format("{} = {} must be between {} and {} mm", key, mm, kShortestPiece_mm, kLongestMat));
}

void check_plate_strand(const PlateMat& mat, const PlateStrand& s, const std::string& where) {
  if (!(std::abs(s.cx_mm) <= kMostWindows * mat.length_mm) || !(std::abs(s.cy_mm) <= kMostWindows * mat.width_mm)) {
    reject(where, fmt::format("cx = {}, cy = {}: a strand's centre lies at most {} windows of {} x {} mm away", s.cx_mm,
                              s.cy_mm, kMostWindows, mat.length_mm, mat.width_mm));
  }
  check_size("length", s.length_mm, where);
  check_size("width", s.width_mm, where);
  if (s.angle_deg && !(std::abs(*s.angle_deg) <= kLargestAngle)) {
    reject(where, fmt::format("angle_deg = {} must be between -{} and {}", *s.angle_deg, kLargestAngle, kLargestAngle));
  }
  if (s.material && s.material->empty()) reject(where, "material must not be an empty text");
  if (std::max(s.length_mm, s.width_mm) > kMostWindows * std::min(mat.length_mm, mat.width_mm)) {
    reject(where,
           fmt::format("length = {}, width = {}: a strand is at most {} times as long as the window of {} x {} mm",
                       s.length_mm, s.width_mm, kMostWindows, mat.length_mm, mat.width_mm));
  }
}

// A strand of a cut mat lies along x or y, within the window.
void check_cut(const PlateMat& mat, const PlateStrand& s, double angle, const std::string& where) {
  if (std::remainder(angle, 90.0) != 0) {
    reject(where, fmt::format("angle_deg = {}: in a mat with \"sides\":\"cut\" strands lie at 0 or 90 degrees; turned "
                              "ones need \"periodic\"",
                              angle));
  }
  const bool upright = std::remainder(angle, 180.0) != 0;
  const auto check = [&](const char* key, double centre, double size, double window) {
    if (centre - size / 2 >= -kMayOverlap_mm && centre + size / 2 <= window + kMayOverlap_mm) return;
    reject(where, fmt::format("{} = {} and the size {} mm along it: the strand reaches beyond the window 0 to {} mm of "
                              "a mat with \"sides\":\"cut\"",
                              key, centre, size, window));
  };
  check("cx", s.cx_mm, upright ? s.width_mm : s.length_mm, mat.length_mm);
  check("cy", s.cy_mm, upright ? s.length_mm : s.width_mm, mat.width_mm);
}

std::string shift_text(const Image& image, const Window& window) {
  if (image.i == 0 && image.j == 0) return "";
  return fmt::format(", moved by ({}, {}) mm as the window repeats", image.i * window.x, image.j * window.y);
}

// Each strand against its own images and, in layers, against those before it.
void check_overlaps(const PlateMat& mat, const std::vector<Rectangle>& strands, const std::string& where) {
  const auto window = mat.window();
  for (std::size_t k = 0; k < strands.size(); ++k) {
    if (window.periodic) {
      if (const auto image = own_image_within(-kMayOverlap_mm, strands[k], window)) {
        reject(at_strand(where, k),
               fmt::format("overlaps its own image{}; the window is too small for it", shift_text(*image, window)));
      }
    }
    if (mat.stack == Stack::kDraped) continue;
    for (std::size_t other = 0; other < k; ++other) {
      const auto image = image_within(-kMayOverlap_mm, strands[k], strands[other], window);
      if (!image) continue;
      reject(at_strand(where, k), fmt::format("overlaps strand {}{}; strands of a layer must not overlap", other + 1,
                                              shift_text(*image, window)));
    }
  }
}

Keys names_of(const std::vector<RoleAngle>& roles) {
  Keys names;
  for (const auto& known : roles) names.push_back(known.role);
  return names;
}

void check_layer(const PlateMat& mat, const PlateLayer& layer, const std::vector<RoleAngle>& roles,
                 const std::string& where) {
  check_role(layer.role, names_of(roles), where);
  if (layer.thickness_mm) check_thickness("thickness_mm", *layer.thickness_mm, where);
  if (layer.strands.empty()) reject(where, "strands is empty; a layer has at least one strand");
  std::vector<Rectangle> outlines;
  for (std::size_t k = 0; k < layer.strands.size(); ++k) {
    const auto& strand = layer.strands[k];
    const double angle = angle_deg(strand, layer.role, roles);
    check_plate_strand(mat, strand, at_strand(where, k));
    if (mat.sides == PlateSides::kCut) check_cut(mat, strand, angle, at_strand(where, k));
    outlines.push_back(outline(strand, angle));
  }
  check_overlaps(mat, outlines, where);
}

std::string plate_strand_text(const PlateStrand& s) {
  auto out = fmt::format("{{\"cx\":{},\"cy\":{},\"length\":{},\"width\":{}", coordinate(s.cx_mm), coordinate(s.cy_mm),
                         coordinate(s.length_mm), coordinate(s.width_mm));
  if (s.angle_deg) out += ",\"angle_deg\":" + coordinate(*s.angle_deg);
  if (s.material) out += ",\"material\":" + Json(*s.material).dump();
  return out + members(s.extra, ",") + "}";
}

std::string plate_layer_text(const PlateLayer& layer) {
  auto out = fmt::format("  {{\"role\":{}", Json(layer.role).dump());
  if (layer.thickness_mm) out += ", \"thickness_mm\":" + Json(*layer.thickness_mm).dump();
  out += members(layer.extra, ", ") + ", \"strands\":[\n";
  for (std::size_t i = 0; i < layer.strands.size(); ++i) {
    out += "    " + plate_strand_text(layer.strands[i]) + (i + 1 < layer.strands.size() ? ",\n" : "]}");
  }
  return out;
}

}  // namespace

const std::vector<std::string>& plate_side_names() {
  static const std::vector<std::string> names{"periodic", "cut"};
  return names;
}

const std::vector<std::string>& stack_names() {
  static const std::vector<std::string> names{"layers", "draped"};
  return names;
}

double PlateMat::thickness_of(std::size_t layer) const {
  return mat::thickness_of(*this, layer);
}

double PlateMat::height_below(std::size_t layer) const {
  return mat::height_below(*this, layer);
}

double angle_deg(const PlateStrand& strand, const std::string& role, const std::vector<RoleAngle>& roles) {
  if (strand.angle_deg) return *strand.angle_deg;
  return std::find_if(roles.begin(), roles.end(), [&](const RoleAngle& known) { return known.role == role; })
      ->angle_deg;
}

Rectangle outline(const PlateStrand& strand, double angle_deg) {
  return rectangle(strand.cx_mm, strand.cy_mm, strand.length_mm, strand.width_mm, angle_deg);
}

int dimensions(const std::filesystem::path& file) {
  return dimensions(files::read_json(file, "a mat file"), file.string());
}

void validate(const PlateMat& mat, const std::vector<RoleAngle>& roles, const std::string& source) {
  check_size("length_mm", mat.length_mm, source);
  check_size("width_mm", mat.width_mm, source);
  check_thickness("layer_thickness_mm", mat.layer_thickness_mm, source);
  for (const double slope : mat.drape_slopes) {
    if (!(slope >= 0 && slope <= kSteepest))
      reject(source, fmt::format("drape_slopes: {} must be between 0 and {}", slope, kSteepest));
  }
  if (mat.layers.empty()) reject(source, "layers is empty; a mat has at least one layer");
  for (std::size_t i = 0; i < mat.layers.size(); ++i) check_layer(mat, mat.layers[i], roles, at_layer(source, i));
}

PlateMat read_plate(const std::filesystem::path& file, const std::vector<RoleAngle>& roles) {
  auto mat = plate_from(files::read_json(file, "a mat file"), file.string());
  validate(mat, roles, file.string());
  return mat;
}

std::string to_text(const PlateMat& mat) {
  const bool draped = mat.stack == Stack::kDraped;
  auto out = fmt::format(
      "{{\"dim\":3, \"length_mm\":{}, \"width_mm\":{}, \"layer_thickness_mm\":{}, \"sides\":\"{}\", \"stack\":\"{}\"",
      coordinate(mat.length_mm), coordinate(mat.width_mm), Json(mat.layer_thickness_mm).dump(),
      plate_side_names()[static_cast<std::size_t>(mat.sides)], stack_names()[static_cast<std::size_t>(mat.stack)]);
  if (draped) out += ", \"drape_slopes\":" + Json(mat.drape_slopes).dump();
  out += members(mat.extra, ", ") + ",\n \"layers\":[\n";
  for (std::size_t i = 0; i < mat.layers.size(); ++i) {
    out += plate_layer_text(mat.layers[i]) + (i + 1 < mat.layers.size() ? ",\n" : "\n");
  }
  return out + " ]}\n";
}

void write(const PlateMat& mat, const std::vector<RoleAngle>& roles, const std::filesystem::path& file) {
  validate(mat, roles, file.string());
  files::write_atomically(file, to_text(mat));
}

}  // namespace strandlab::mat
