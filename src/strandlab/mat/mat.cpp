#include "strandlab/mat/mat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "strandlab/core/error.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/files/json_text.hpp"
#include "strandlab/mat/file_format.hpp"

namespace strandlab::mat {
namespace {

const Keys kMatKeys{"length_mm", "layer_thickness_mm", "layers"};
const Keys kLayerKeys{"role", "thickness_mm", "strands"};
const Keys kStrandKeys{"x0", "x1", "angle_deg", "material"};

constexpr double kMostThrough = 1e6;  // points through a layer: beyond any memory, within an int

Strand strand_from(const Json& json, const std::string& where) {
  require_object(json, where);
  Strand strand;
  strand.x0_mm = on_raster(number(member(json, "x0", kStrandKeys, where), "x0", "mm", where));
  strand.x1_mm = on_raster(number(member(json, "x1", kStrandKeys, where), "x1", "mm", where));
  if (json.contains("angle_deg")) strand.angle_deg = number(json["angle_deg"], "angle_deg", "degrees", where);
  if (json.contains("material")) strand.material = text(json["material"], "material", where);
  strand.extra = others(json, kStrandKeys);
  return strand;
}

Layer layer_from(const Json& json, const std::string& where) {
  require_object(json, where);
  Layer layer;
  layer.role = text(member(json, "role", kLayerKeys, where), "role", where);
  if (json.contains("thickness_mm")) layer.thickness_mm = number(json["thickness_mm"], "thickness_mm", "mm", where);
  const Json& strands = list(member(json, "strands", kLayerKeys, where), "strands", where);
  for (std::size_t i = 0; i < strands.size(); ++i) {
    layer.strands.push_back(strand_from(strands[i], at_strand(where, i)));
  }
  layer.extra = others(json, kLayerKeys);
  return layer;
}

Mat mat_from(const Json& json, const std::string& source) {
  require_object(json, source);
  if (dimensions(json, source) == 3) {
    reject(source, "\"dim\":3 makes it the mat of a plate (3D); here a section mat is read, whose file has no \"dim\"");
  }
  Mat mat;
  mat.length_mm = on_raster(number(member(json, "length_mm", kMatKeys, source), "length_mm", "mm", source));
  mat.layer_thickness_mm =
      number(member(json, "layer_thickness_mm", kMatKeys, source), "layer_thickness_mm", "mm", source);
  const Json& layers = list(member(json, "layers", kMatKeys, source), "layers", source);
  for (std::size_t i = 0; i < layers.size(); ++i) mat.layers.push_back(layer_from(layers[i], at_layer(source, i)));
  mat.extra = others(json, kMatKeys);
  return mat;
}

void check_strand(const Mat& mat, const Strand& s, const std::string& where) {
  if (!std::isfinite(s.x0_mm) || !std::isfinite(s.x1_mm)) {
    reject(where, fmt::format("x0 = {}, x1 = {} must be finite numbers (mm)", s.x0_mm, s.x1_mm));
  }
  if (!(on_raster(s.x1_mm) > on_raster(s.x0_mm))) {
    reject(where, fmt::format("x1 = {} mm must be larger than x0 = {} mm (by 1e-6 mm or more)", s.x1_mm, s.x0_mm));
  }
  if (on_raster(s.x1_mm) - on_raster(s.x0_mm) < kShortestPiece_mm - 0.5 / kResolution) {
    reject(where,
           fmt::format("x0 = {}, x1 = {}: a strand is at least {} mm long", s.x0_mm, s.x1_mm, kShortestPiece_mm));
  }
  if (on_raster(s.x0_mm) < 0 || on_raster(s.x1_mm) > on_raster(mat.length_mm)) {
    reject(where,
           fmt::format("x0 = {}, x1 = {} lies outside the mat's window 0 to {} mm", s.x0_mm, s.x1_mm, mat.length_mm));
  }
  if (s.angle_deg && !std::isfinite(*s.angle_deg)) {
    reject(where, fmt::format("angle_deg = {} must be a finite number", *s.angle_deg));
  }
  if (s.material && s.material->empty()) reject(where, "material must not be an empty text");
}

void check_overlap(const std::vector<Strand>& strands, const std::string& where) {
  std::vector<std::size_t> order(strands.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return strands[a].x0_mm < strands[b].x0_mm; });
  for (std::size_t i = 1; i < order.size(); ++i) {
    const auto& left = strands[order[i - 1]];
    const auto& right = strands[order[i]];
    if (on_raster(right.x0_mm) < on_raster(left.x1_mm)) {
      reject(at_strand(where, order[i]),
             fmt::format("x0 = {} mm overlaps strand {}, which ends at x1 = {} mm; strands of a layer must not overlap",
                         right.x0_mm, order[i - 1] + 1, left.x1_mm));
    }
  }
}

std::string strand_text(const Strand& s) {
  auto out = fmt::format("{{\"x0\":{},\"x1\":{}", coordinate(s.x0_mm), coordinate(s.x1_mm));
  if (s.angle_deg) out += ",\"angle_deg\":" + Json(*s.angle_deg).dump();
  if (s.material) out += ",\"material\":" + Json(*s.material).dump();
  return out + members(s.extra, ",") + "}";
}

std::string layer_text(const Layer& layer) {
  auto out = fmt::format("  {{\"role\":{}", Json(layer.role).dump());
  if (layer.thickness_mm) out += ", \"thickness_mm\":" + Json(*layer.thickness_mm).dump();
  out += members(layer.extra, ", ") + ", \"strands\":[";
  for (std::size_t i = 0; i < layer.strands.size(); ++i) out += (i ? ", " : "") + strand_text(layer.strands[i]);
  return out + "]}";
}

}  // namespace

double Mat::thickness_of(std::size_t layer) const {
  return mat::thickness_of(*this, layer);
}

double Mat::height_below(std::size_t layer) const {
  return mat::height_below(*this, layer);
}

double thinnest_layer(const Mat& mat) {
  return mat::thinnest(mat);
}

int through(double thickness_mm, double thinnest_mm, int through_thinnest) {
  const double exact = through_thinnest * (thickness_mm / thinnest_mm);
  return static_cast<int>(std::lround(std::min(exact, kMostThrough)));
}

void validate(const Mat& mat, const std::vector<std::string>& kinds, const std::string& source) {
  if (!(mat.length_mm > 0) || !(mat.length_mm <= kLongestMat)) {
    reject(source, fmt::format("length_mm = {} must be positive and at most {} mm", mat.length_mm, kLongestMat));
  }
  check_thickness("layer_thickness_mm", mat.layer_thickness_mm, source);
  if (mat.layers.empty()) reject(source, "layers is empty; a mat has at least one layer");
  for (std::size_t i = 0; i < mat.layers.size(); ++i) {
    const auto& layer = mat.layers[i];
    const auto where = at_layer(source, i);
    check_role(layer.role, kinds, where);
    if (layer.thickness_mm) check_thickness("thickness_mm", *layer.thickness_mm, where);
    if (layer.strands.empty()) reject(where, "strands is empty; a layer has at least one strand");
    for (std::size_t k = 0; k < layer.strands.size(); ++k) check_strand(mat, layer.strands[k], at_strand(where, k));
    check_overlap(layer.strands, where);
  }
}

Mat read(const std::filesystem::path& file, const std::vector<std::string>& kinds) {
  const auto source = file.string();
  Mat mat = mat_from(files::read_json(file, "a mat file"), source);
  validate(mat, kinds, source);
  for (auto& layer : mat.layers) {
    std::sort(layer.strands.begin(), layer.strands.end(),
              [](const Strand& a, const Strand& b) { return a.x0_mm < b.x0_mm; });
  }
  return mat;
}

std::string to_text(const Mat& mat) {
  auto out = fmt::format("{{\"length_mm\":{}, \"layer_thickness_mm\":{}{},\n \"layers\":[\n", coordinate(mat.length_mm),
                         Json(mat.layer_thickness_mm).dump(), members(mat.extra, ", "));
  for (std::size_t i = 0; i < mat.layers.size(); ++i) {
    out += layer_text(mat.layers[i]) + (i + 1 < mat.layers.size() ? ",\n" : "\n");
  }
  return out + " ]}\n";
}

void write(const Mat& mat, const std::filesystem::path& file) {
  validate(mat, {}, file.string());
  files::write_atomically(file, to_text(mat));
}

}  // namespace strandlab::mat
