// strandlab doctor: its self-test knows this engine's numbers on every instruction set, and what is missing is named.
#include "strandlab/run/doctor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "strandlab/mpm/dispatch.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::run {
namespace {

// The bits are those of a release build by g++ 12; others agree in the numbers.
TEST(Doctor, SelfTestHoldsOnEveryInstructionSet) {
  for (const auto& name : mpm::instruction_sets()) {
    ::setenv(mpm::kInstructionSetVariable, name.c_str(), 1);
    const auto test = self_test();
    EXPECT_LE(test.difference, kSelfTestLimit) << name << ": " << fmt::format("{}", fmt::join(test.numbers, ", "));
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ == 12 && defined(NDEBUG) && !defined(__AVX__) && \
    defined(__x86_64__)
    EXPECT_TRUE(test.same_bits) << name << ": " << test.bits;
#endif
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
  EXPECT_THAT(text, testing::HasSubstr(" bits as pressed, numbers differ by "));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("WRONG")));
}

// A program that is there is named with the first line of what it says of itself, whatever its folder is called.
TEST(Doctor, SaysVersions) {
  const test::TemporaryFolder folder;
  const auto programs = folder.path() / "it's here";
  std::filesystem::create_directory(programs);
  const auto put = [&](const char* name, const char* script) {
    std::ofstream(programs / name) << "#!/bin/sh\n" << script;
    std::filesystem::permissions(programs / name, std::filesystem::perms::owner_all);
  };
  put("gnuplot", "[ \"$1\" = --version ] && echo 'gnuplot 5.4 patchlevel 4' && echo more");
  put("ffmpeg", "[ \"$1\" = -version ] && echo 'ffmpeg version 5.1.6 Copyright (c) 2000-2024'");
  put("mpirun", "exit 1");
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (programs.string() + ":" + path).c_str(), 1);
  const auto text = text_of(diagnose());
  ::setenv("PATH", path.c_str(), 1);
  for (const auto* line :
       {"/gnuplot, gnuplot 5.4 patchlevel 4\n", "/ffmpeg, ffmpeg version 5.1.6\n", "/mpirun: not used by this version"})
    EXPECT_THAT(text, testing::HasSubstr(programs.string() + line));
}

TEST(Doctor, SaysWrong) {
  EXPECT_EQ(text_of({{Diagnosis::State::kBad, "self-test", "differs by 1", "do not use it"}}),
            "WRONG   self-test        differs by 1: do not use it\n");
}

}  // namespace
}  // namespace strandlab::run
