#include "strandlab/core/atomic_file.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "strandlab/core/error.hpp"
#include "support/temporary_folder.hpp"
#include "support/unwritable.hpp"

namespace strandlab {
namespace {

using test::contents;
using test::message_of;
using test::TemporaryFolder;

TEST(AtomicFile, ReplacesAndLeavesNoTemporary) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.csv", "old");
  write_atomically(folder / "a.csv", "new");
  EXPECT_EQ(contents(folder / "a.csv"), "new");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, ReplacesTheTemporaryOfAKilledRun) {
  const TemporaryFolder folder;
  test::put(folder / "a.csv.tmp", "half of a much longer file that was being written");
  write_atomically(folder / "a.csv", "whole");
  EXPECT_EQ(contents(folder / "a.csv"), "whole");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, IsStillTheOldOneUntilTheRename) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.csv", "old");
  std::string seen;
  write_atomically(folder / "a.csv", "new",
                   [&] { seen = contents(folder / "a.csv") + contents(folder / "a.csv.tmp"); });
  EXPECT_EQ(seen, "oldnew");
}

TEST(AtomicFile, FailureBeforeTheRenameLeavesTheOldFile) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.csv", "old");
  EXPECT_THROW(write_atomically(folder / "a.csv", "new", [] { throw std::logic_error("stop"); }), std::logic_error);
  EXPECT_EQ(contents(folder / "a.csv"), "old");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, MissingFolderIsBadInput) {
  const TemporaryFolder folder;
  const auto file = folder / "none" / "a.csv";
  EXPECT_EQ(message_of<InputError>([&] { write_atomically(file, "x"); }),
            "cannot write " + file.string() + ": the folder " + (folder / "none").string() + " does not exist");
}

TEST(AtomicFile, FolderInPlaceOfTheFileIsBadInput) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "a.csv");
  EXPECT_NE(message_of<InputError>([&] { write_atomically(folder / "a.csv", "x"); }).find("a folder of that name"),
            std::string::npos);
}

TEST(AtomicFile, FolderWithoutPermissionIsBadInput) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.csv", "old");
  {
    const test::ReadOnly locked(folder.path());
    EXPECT_NE(message_of<InputError>([&] { write_atomically(folder / "a.csv", "x"); }).find("Permission denied"),
              std::string::npos);
  }
  EXPECT_EQ(contents(folder / "a.csv"), "old");
}

TEST(AtomicFile, FullDiskFailsTheRunAndLeavesTheOldFile) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.csv", "old");
  {
    const test::FullDisk full(1000);
    const std::string message =
        message_of<RunError>([&] { write_atomically(folder / "a.csv", std::string(5000, 'x')); });
    EXPECT_NE(message.find("a.csv: writing failed"), std::string::npos) << message;
  }
  EXPECT_EQ(contents(folder / "a.csv"), "old");
  EXPECT_EQ(folder.files(), 1U);
}

}  // namespace
}  // namespace strandlab
