#include <algorithm>

#include "strandlab/core/error.hpp"
#include "strandlab/vtest/kinds/test.hpp"

namespace strandlab::vtest {

const VirtualTest& test_of(Kind kind) {
  switch (kind) {
#define VIRTUAL_TEST(name) \
  case Kind::k##name:      \
    return test<Kind::k##name>();
    STRANDLAB_VIRTUAL_TESTS(VIRTUAL_TEST)
#undef VIRTUAL_TEST
  }
  __builtin_unreachable();
}

std::vector<Kind> all_kinds() {
  return {
#define VIRTUAL_TEST(name) Kind::k##name,
      STRANDLAB_VIRTUAL_TESTS(VIRTUAL_TEST)
#undef VIRTUAL_TEST
  };
}

const char* name(Kind kind) {
  return test_of(kind).name;
}

const char* label(Kind kind) {
  return test_of(kind).label;
}

ClosedForm closed_form(Kind kind) {
  return test_of(kind).closed_form;
}

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const Kind kind : all_kinds()) names.emplace_back(name(kind));
  return names;
}

std::string allowed_kinds() {
  std::string text;
  for (const auto& kind : kind_names()) text += (text.empty() ? "" : ", ") + kind;
  return text;
}

Kind kind_from_name(const std::string& name_given) {
  const auto kinds = all_kinds();
  const auto at = std::find_if(kinds.begin(), kinds.end(), [&](Kind kind) { return name_given == name(kind); });
  if (at != kinds.end()) return *at;
  throw InputError("unknown virtual test \"" + name_given + "\", allowed: " + allowed_kinds());
}

}  // namespace strandlab::vtest
