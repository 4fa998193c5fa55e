// strandlab doctor: its self-test knows this engine's numbers on every instruction set, and what is missing is named.
#include "strandlab/run/doctor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "strandlab/mpm/dispatch.hpp"

namespace strandlab::run {
namespace {

TEST(Doctor, SelfTestHoldsOnEveryInstructionSet) {
  for (const auto& name : mpm::instruction_sets()) {
    ::setenv(mpm::kInstructionSetVariable, name.c_str(), 1);
    EXPECT_LE(self_test(), kSelfTestLimit) << name << ": " << fmt::format("{}", fmt::join(self_test_numbers(), ", "));
  }
  ::unsetenv(mpm::kInstructionSetVariable);
}

TEST(Doctor, NamesWhatIsMissing) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const auto list = diagnose();
  ::setenv("PATH", path.c_str(), 1);
  const auto text = text_of(list);
  EXPECT_THAT(text, testing::HasSubstr("missing gnuplot          plots of a run as PNG; Debian: gnuplot-nox\n"));
  EXPECT_THAT(text, testing::HasSubstr("ok      self-test        differs by "));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("WRONG")));
}

TEST(Doctor, SaysWrong) {
  EXPECT_EQ(text_of({{Diagnosis::State::kBad, "self-test", "differs by 1", "do not use it"}}),
            "WRONG   self-test        differs by 1: do not use it\n");
}

}  // namespace
}  // namespace strandlab::run
