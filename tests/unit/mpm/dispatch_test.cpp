// Which build of the kernels runs: the best one, or the one that STRANDLAB_ISA names.
#include "strandlab/mpm/dispatch.hpp"

#include <gtest/gtest.h>

#include "strandlab/core/error.hpp"
#include "strandlab/mpm/kernels.hpp"
#include "support/environment.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::mpm {
namespace {

TEST(InstructionSet, IsTheBestUnlessOneIsNamed) {
  const auto sets = instruction_sets();
  ASSERT_FALSE(sets.empty());
  EXPECT_EQ(sets.back(), "generic");
  for (const char* unset : {static_cast<const char*>(nullptr), ""}) {
    const test::EnvironmentVariable variable(kInstructionSetVariable, unset);
    EXPECT_EQ(instruction_set(), sets.front());
  }
  std::vector<const Kernels<2>*> builds;
  for (const auto& set : sets) {
    const test::EnvironmentVariable variable(kInstructionSetVariable, set.c_str());
    EXPECT_EQ(instruction_set(), set);
    for (const auto* other : builds) EXPECT_NE(&kernels<2>(), other) << set << " is another build under its name";
    builds.push_back(&kernels<2>());
  }
}

TEST(InstructionSet, RefusesOneThatThisMachineHasNot) {
  const test::EnvironmentVariable variable(kInstructionSetVariable, "avx1024");
  for (const auto& message :
       {test::message_of<InputError>([] { instruction_set(); }), test::message_of<InputError>([] { kernels<3>(); })}) {
    EXPECT_NE(message.find("STRANDLAB_ISA is \"avx1024\"; this machine has "), std::string::npos) << message;
    for (const auto& set : instruction_sets()) EXPECT_NE(message.find(set), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace strandlab::mpm
