#include <algorithm>

#include "strandlab/core/error.hpp"
#include "strandlab/vtest/kinds/test.hpp"

namespace strandlab::vtest {

const VirtualTest& test_of(TestKind kind) {
  switch (kind) {
#define VIRTUAL_TEST(name) \
  case TestKind::k##name:  \
    return test<TestKind::k##name>();
    STRANDLAB_VIRTUAL_TESTS(VIRTUAL_TEST)
#undef VIRTUAL_TEST
  }
  __builtin_unreachable();
}

std::vector<TestKind> all_tests() {
  return {
#define VIRTUAL_TEST(name) TestKind::k##name,
      STRANDLAB_VIRTUAL_TESTS(VIRTUAL_TEST)
#undef VIRTUAL_TEST
  };
}

const char* name(TestKind kind) {
  return test_of(kind).name;
}

const char* label(TestKind kind) {
  return test_of(kind).label;
}

ClosedForm closed_form(TestKind kind) {
  return test_of(kind).closed_form;
}

std::vector<std::string> test_names() {
  std::vector<std::string> names;
  for (const TestKind kind : all_tests()) names.emplace_back(name(kind));
  return names;
}

std::string allowed_tests() {
  std::string text;
  for (const auto& kind : test_names()) text += (text.empty() ? "" : ", ") + kind;
  return text;
}

TestKind test_from_name(const std::string& name_given) {
  const auto kinds = all_tests();
  const auto at = std::find_if(kinds.begin(), kinds.end(), [&](TestKind kind) { return name_given == name(kind); });
  if (at != kinds.end()) return *at;
  throw InputError("unknown virtual test \"" + name_given + "\", allowed: " + allowed_tests());
}

}  // namespace strandlab::vtest
