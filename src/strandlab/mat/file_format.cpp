#include "strandlab/mat/file_format.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "strandlab/core/error.hpp"
#include "strandlab/core/nearest.hpp"
#include "strandlab/core/text.hpp"

namespace strandlab::mat {
namespace {

// A JSON value as a message shows it: short, whatever it is.
std::string shown(const Json& value) {
  return shortened(value.dump(-1, ' ', false, Json::error_handler_t::replace), 40);
}

}  // namespace

void reject(const std::string& where, const std::string& what) {
  throw InputError(fmt::format("{}: {}", where, what));
}

std::string at_layer(const std::string& source, std::size_t layer) {
  return fmt::format("{}: layer {}", source, layer + 1);
}
std::string at_strand(const std::string& layer, std::size_t strand) {
  return fmt::format("{}, strand {}", layer, strand + 1);
}

const Json& member(const Json& object, const char* key, const Keys& known, const std::string& where) {
  const auto found = object.find(key);
  if (found != object.end()) return *found;
  std::string hint;
  for (const auto& item : object.items()) {
    const bool unknown = std::find(known.begin(), known.end(), item.key()) == known.end();
    if (unknown && nearest(item.key(), {key}) == key)
      hint = fmt::format("; is \"{}\" a misspelling of it?", item.key());
  }
  reject(where, fmt::format("key \"{}\" is missing{}", key, hint));
}

double number(const Json& value, const char* key, const char* unit, const std::string& where) {
  if (!value.is_number()) reject(where, fmt::format("{} = {} must be a number ({})", key, shown(value), unit));
  return value.get<double>();
}

std::string text(const Json& value, const char* key, const std::string& where) {
  if (!value.is_string()) reject(where, fmt::format("{} = {} must be a text in quotes", key, shown(value)));
  return value.get<std::string>();
}

const Json& list(const Json& value, const char* key, const std::string& where) {
  if (!value.is_array()) reject(where, fmt::format("{} = {} must be a list", key, shown(value)));
  return value;
}

void require_object(const Json& value, const std::string& where) {
  if (!value.is_object()) reject(where, fmt::format("found {} in place of an object {{...}}", shown(value)));
}

std::string others(const Json& object, const Keys& known) {
  Json extra = Json::object();
  for (const auto& item : object.items()) {
    if (std::find(known.begin(), known.end(), item.key()) == known.end()) extra[item.key()] = item.value();
  }
  return extra.empty() ? "" : extra.dump();
}

int dimensions(const Json& mat, const std::string& source) {
  if (!mat.is_object() || !mat.contains("dim")) return 2;
  const Json& dim = mat["dim"];
  for (const int known : {2, 3}) {
    if (dim == known) return known;
  }
  reject(source, fmt::format("dim = {} must be 2 (a section mat; also without this key) or 3 (the mat of a plate)",
                             shown(dim)));
}

void check_thickness(const char* key, double thickness_mm, const std::string& where) {
  if (thickness_mm >= kThinnestLayer && thickness_mm <= kLongestMat) return;
  reject(where, fmt::format("{} = {} must be between {} and {} mm", key, thickness_mm, kThinnestLayer, kLongestMat));
}

void check_role(const std::string& role, const Keys& kinds, const std::string& where) {
  if (role.empty()) reject(where, "role must not be empty; it names a strand kind");
  if (kinds.empty() || std::find(kinds.begin(), kinds.end(), role) != kinds.end()) return;
  const auto near = nearest(role, kinds);
  reject(where, fmt::format("unknown role \"{}\"{}; the strand kinds are {}", shortened(role),
                            near.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", near), quoted_list(kinds)));
}

std::string coordinate(double value) {
  auto digits = fmt::format("{:.6f}", on_raster(value) + 0.0);
  while (digits.back() == '0' && digits[digits.size() - 2] != '.') digits.pop_back();
  return digits;
}

std::string members(const std::string& extra, const char* separator) {
  return extra.size() > 2 ? separator + extra.substr(1, extra.size() - 2) : "";
}

}  // namespace strandlab::mat
