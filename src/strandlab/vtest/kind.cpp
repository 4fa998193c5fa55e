#include <algorithm>
#include <array>

#include "strandlab/core/error.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::vtest {
namespace {

struct Words {
  Kind kind;
  const char *name, *label;
};
constexpr std::array kWords{Words{Kind::kTension, "tension", "Tension"},
                            Words{Kind::kBendingEndRotation, "bending_end_rotation", "Bending (end rotation)"},
                            Words{Kind::kBendingEndCouple, "bending_end_couple", "Bending (end couple)"},
                            Words{Kind::kBending3Point, "bending_3_point", "Bending (3 points)"},
                            Words{Kind::kBending4Point, "bending_4_point", "Bending (4 points)"}};

const Words& words_of(Kind kind) {
  return *std::find_if(kWords.begin(), kWords.end(), [kind](const auto& words) { return words.kind == kind; });
}

}  // namespace

const char* name(Kind kind) {
  return words_of(kind).name;
}

const char* label(Kind kind) {
  return words_of(kind).label;
}

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  names.reserve(kWords.size());
  for (const auto& words : kWords) names.emplace_back(words.name);
  return names;
}

std::string allowed_kinds() {
  std::string text;
  for (const auto& kind : kind_names()) text += (text.empty() ? "" : ", ") + kind;
  return text;
}

Kind kind_from_name(const std::string& name_given) {
  for (const auto& words : kWords) {
    if (name_given == words.name) return words.kind;
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
