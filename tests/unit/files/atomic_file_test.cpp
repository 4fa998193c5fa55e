#include "strandlab/files/atomic_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <string>

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
  files::write_atomically(folder / "a.csv", "old");
  files::write_atomically(folder / "a.csv", "new");
  EXPECT_EQ(contents(folder / "a.csv"), "new");
  EXPECT_EQ(folder.files(), 1U);
}

// Text of the temporary files in a folder.
std::string temporaries(const TemporaryFolder& folder) {
  std::string text;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    if (files::is_temporary(entry.path())) text += contents(entry.path());
  }
  return text;
}

TEST(AtomicFile, IsStillTheOldOneUntilTheRename) {
  const TemporaryFolder folder;
  files::write_atomically(folder / "a.csv", "old");
  std::string seen;
  files::write_atomically(folder / "a.csv", "new", [&] { seen = contents(folder / "a.csv") + temporaries(folder); });
  EXPECT_EQ(seen, "oldnew");
}

// Each has a temporary file of its own: neither cuts the other's short or takes it away.
TEST(AtomicFile, IsWrittenTwiceAtTheSameTime) {
  const TemporaryFolder folder;
  files::write_atomically(folder / "a.csv", "slow", [&] {
    files::write_atomically(folder / "a.csv", "quick");
    EXPECT_EQ(contents(folder / "a.csv"), "quick");
    EXPECT_EQ(temporaries(folder), "slow");
  });
  EXPECT_EQ(contents(folder / "a.csv"), "slow");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, ATemporaryFileIsKnownByItsName) {
  EXPECT_TRUE(files::is_temporary("run/report.html.4711-2.tmp"));
  for (const auto* name : {"report.html", "report.html.tmp", "notes-2.tmp", "4711-2.tmp", "a.4711-2.tmp.csv"})
    EXPECT_FALSE(files::is_temporary(name)) << name;
}

// A process that has ended and been waited for has a number that no process has; this one and the first one run.
TEST(AtomicFile, WhatAKilledProgramLeftIsRemovedAndWhatIsBeingWrittenStays) {
  const TemporaryFolder folder;
  const auto dead = ::fork();
  ASSERT_GE(dead, 0);
  if (dead == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(dead, nullptr, 0), dead);
  const auto left = [&](const std::string& file, pid_t process) {
    const auto path = folder / fmt::format("{}.{}-7.tmp", file, process);
    test::put(path, "half");
    return path;
  };
  const auto stays = {left("a.csv", ::getpid()), left("a.csv", 1), folder / "a.csv.tmp"};
  test::put(folder / "a.csv.tmp", "a user's");
  const auto other = left("b.csv", dead), no_process = left("a.csv", 0), half = left("a.csv", dead);
  files::remove_abandoned(folder.path(), "a.csv.");
  for (const auto& file : {half, no_process}) EXPECT_FALSE(std::filesystem::exists(file)) << file;
  for (const auto& file : stays) EXPECT_TRUE(std::filesystem::exists(file)) << file;
  EXPECT_TRUE(std::filesystem::exists(other));
  files::remove_abandoned(folder.path());
  EXPECT_FALSE(std::filesystem::exists(other));
}

TEST(MakeFolder, SaysWhatIsInTheWay) {
  const TemporaryFolder folder;
  files::make_folder(folder / "a/b");
  files::make_folder(folder / "a/b");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a/b"));
  test::put(folder / "file", "x");
  EXPECT_NE(message_of<InputError>([&] { files::make_folder(folder / "file"); }).find("Not a directory"),
            std::string::npos);
  const test::ReadOnly locked(folder.path());
  EXPECT_NE(message_of<InputError>([&] { files::make_folder(folder / "c"); }).find("Permission denied"),
            std::string::npos);
}

TEST(AtomicFile, ANameThatCannotBeIsBadInput) {
  const TemporaryFolder folder;
  EXPECT_NE(
      message_of<InputError>([&] { files::write_atomically(folder / std::string(5000, 'x'), "x"); }).find("too long"),
      std::string::npos);
  std::filesystem::create_symlink(folder / "loop", folder / "loop");
  EXPECT_NE(message_of<InputError>([&] { files::write_atomically(folder / "loop/a.csv", "x"); }).find("loop"),
            std::string::npos);
}

TEST(AtomicFile, FailureBeforeTheRenameLeavesTheOldFile) {
  const TemporaryFolder folder;
  files::write_atomically(folder / "a.csv", "old");
  EXPECT_THROW(files::write_atomically(folder / "a.csv", "new", [] { throw std::logic_error("stop"); }),
               std::logic_error);
  EXPECT_EQ(contents(folder / "a.csv"), "old");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, MissingFolderIsBadInput) {
  const TemporaryFolder folder;
  const auto file = folder / "none" / "a.csv";
  EXPECT_EQ(message_of<InputError>([&] { files::write_atomically(file, "x"); }),
            "cannot write " + file.string() + ": the folder " + (folder / "none").string() + " does not exist");
}

TEST(AtomicFile, FolderInPlaceOfTheFileIsBadInput) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "a.csv");
  EXPECT_NE(
      message_of<InputError>([&] { files::write_atomically(folder / "a.csv", "x"); }).find("a folder of that name"),
      std::string::npos);
}

TEST(AtomicFile, FolderWithoutPermissionIsBadInput) {
  const TemporaryFolder folder;
  files::write_atomically(folder / "a.csv", "old");
  {
    const test::ReadOnly locked(folder.path());
    EXPECT_NE(message_of<InputError>([&] { files::write_atomically(folder / "a.csv", "x"); }).find("Permission denied"),
              std::string::npos);
  }
  EXPECT_EQ(contents(folder / "a.csv"), "old");
}

TEST(AtomicFile, FullDiskFailsTheRunAndLeavesTheOldFile) {
  const TemporaryFolder folder;
  files::write_atomically(folder / "a.csv", "old");
  {
    const test::FullDisk full(1000);
    const std::string message =
        message_of<RunError>([&] { files::write_atomically(folder / "a.csv", std::string(5000, 'x')); });
    EXPECT_NE(message.find("a.csv: writing failed"), std::string::npos) << message;
  }
  EXPECT_EQ(contents(folder / "a.csv"), "old");
  EXPECT_EQ(folder.files(), 1U);
}

}  // namespace
}  // namespace strandlab
