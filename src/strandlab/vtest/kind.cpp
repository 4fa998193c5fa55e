#include <array>

#include "strandlab/core/error.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::vtest {
namespace {
constexpr std::array kKinds{Kind::kTension, Kind::kBendingEndRotation, Kind::kBendingEndCouple};
}

const char* name(Kind kind) {
  switch (kind) {
    case Kind::kTension:
      return "tension";
    case Kind::kBendingEndRotation:
      return "bending_end_rotation";
    case Kind::kBendingEndCouple:
      return "bending_end_couple";
  }
  return "";
}

std::string allowed_kinds() {
  std::string text;
  for (const Kind kind : kKinds) text += (text.empty() ? "" : ", ") + std::string(name(kind));
  return text;
}

Kind kind_from_name(const std::string& name_given) {
  for (const Kind kind : kKinds) {
    if (name_given == name(kind)) return kind;
  }
  throw InputError("unknown virtual test \"" + name_given + "\", allowed: " + allowed_kinds());
}

}  // namespace strandlab::vtest
