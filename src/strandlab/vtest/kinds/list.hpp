// The virtual tests there are. A test is a source file of this folder (test.hpp says what it holds) and its line here.
#pragma once

// VIRTUAL_TEST(name), in the order in which they are listed to people.
#define STRANDLAB_VIRTUAL_TESTS(VIRTUAL_TEST) \
  VIRTUAL_TEST(Tension)                       \
  VIRTUAL_TEST(BendingEndRotation)            \
  VIRTUAL_TEST(BendingEndCouple)              \
  VIRTUAL_TEST(Bending3Point)                 \
  VIRTUAL_TEST(Bending4Point)

namespace strandlab::vtest {

enum class TestKind {
#define VIRTUAL_TEST(name) k##name,
  STRANDLAB_VIRTUAL_TESTS(VIRTUAL_TEST)
#undef VIRTUAL_TEST
};

struct VirtualTest;

// What a test of this kind is. Each is defined in the file of its test.
template <TestKind kind>
const VirtualTest& test();
#define VIRTUAL_TEST(name) \
  template <>              \
  const VirtualTest& test<TestKind::k##name>();
STRANDLAB_VIRTUAL_TESTS(VIRTUAL_TEST)
#undef VIRTUAL_TEST

}  // namespace strandlab::vtest
