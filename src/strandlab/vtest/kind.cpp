#include <algorithm>
#include <array>

#include "strandlab/core/error.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::vtest {
namespace {
constexpr std::array kKinds{Kind::kTension, Kind::kBendingEndRotation, Kind::kBendingEndCouple, Kind::kBending3Point,
                            Kind::kBending4Point};
}

const char* name(Kind kind) {
  switch (kind) {
    case Kind::kTension:
      return "tension";
    case Kind::kBendingEndRotation:
      return "bending_end_rotation";
    case Kind::kBendingEndCouple:
      return "bending_end_couple";
    case Kind::kBending3Point:
      return "bending_3_point";
    case Kind::kBending4Point:
      return "bending_4_point";
  }
  return "";
}

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  names.reserve(std::size(kKinds));
  for (const Kind kind : kKinds) names.emplace_back(name(kind));
  return names;
}

std::string allowed_kinds() {
  std::string text;
  for (const auto& kind : kind_names()) text += (text.empty() ? "" : ", ") + kind;
  return text;
}

Kind kind_from_name(const std::string& name_given) {
  for (const Kind kind : kKinds) {
    if (name_given == name(kind)) return kind;
  }
  throw InputError("unknown virtual test \"" + name_given + "\", allowed: " + allowed_kinds());
}

double needed_length_mm(const Options& options, double thickness_mm) {
  const bool on_supports = std::any_of(options.kinds.begin(), options.kinds.end(), [](Kind kind) {
    return kind == Kind::kBending3Point || kind == Kind::kBending4Point;
  });
  return on_supports ? (options.span_to_thickness + 2) * thickness_mm : 0;
}

}  // namespace strandlab::vtest
