#include "strandlab/core/write_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "strandlab/core/error.hpp"

namespace strandlab {
namespace {

namespace fs = std::filesystem;

class WriteFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("strandlab_write_file_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  static std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path folder_;
};

TEST_F(WriteFile, ReplacesTheWholeFile) {
  write_file(folder_ / "a.txt", "first, longer\n");
  write_file(folder_ / "a.txt", "second\n");
  EXPECT_EQ(content(folder_ / "a.txt"), "second\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1) << "temporary file left";
}

TEST_F(WriteFile, SaysWhichFileAndWhy) {
  try {
    write_file(folder_ / "missing" / "a.txt", "text");
    FAIL() << "no folder, yet no error";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("missing/a.txt"), std::string::npos) << message;
    EXPECT_NE(message.find("No such file"), std::string::npos) << message;
  }
}

TEST_F(WriteFile, LeavesTheOldFileWhenItFails) {
  fs::create_directories(folder_ / "a.txt" / "in_the_way");  // a folder cannot be replaced by a file
  EXPECT_THROW(write_file(folder_ / "a.txt", "text"), InputError);
  EXPECT_TRUE(fs::is_directory(folder_ / "a.txt" / "in_the_way"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1) << "temporary file left";
}

// /dev/full reports a full disk for every write.
TEST_F(WriteFile, ReportsAFullDisk) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  fs::create_symlink("/dev/full", folder_ / "a.txt.tmp");
  try {
    write_file(folder_ / "a.txt", "text");
    FAIL() << "disk full, yet no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("No space left"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(fs::exists(folder_ / "a.txt"));
}

}  // namespace
}  // namespace strandlab
