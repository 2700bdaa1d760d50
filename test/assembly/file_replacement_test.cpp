#include "heerk_rotor/assembly/file_replacement.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "full_disk.hpp"

namespace heerk_rotor {
namespace {

class FileReplacementTest : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directory(directory_); }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  static std::string contents(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  static std::string errorOf(const std::string& file, const std::string& text) {
    try {
      replaceFile(file, text);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "saved";
  }
  std::size_t filesInDirectory() const {
    const std::filesystem::directory_iterator files(directory_);
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }
  const std::string directory_ = testing::TempDir() + "file_replacement_test_" + std::to_string(::getpid());
  const std::string file_ = directory_ + "/target";
};

TEST_F(FileReplacementTest, writesNewFilesAndReplacesOldOnes) {
  replaceFile(file_, "first");
  EXPECT_EQ(contents(file_), "first");
  replaceFile(file_, std::string("second\0part", 11));
  EXPECT_EQ(contents(file_), std::string("second\0part", 11));
  EXPECT_EQ(filesInDirectory(), 1u);
}

TEST_F(FileReplacementTest, writesIntoTheWorkingDirectory) {
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(directory_);
  const std::string error = errorOf("target", "here");
  std::filesystem::current_path(before);
  EXPECT_EQ(error, "saved");
  EXPECT_EQ(contents(file_), "here");
}

TEST_F(FileReplacementTest, keepsTheOldFileWhenTheDiskIsFull) {
  replaceFile(file_, "old");
  std::string error;
  {
    const FullDisk full(1000);
    error = errorOf(file_, std::string(100000, 'x'));
  }
  EXPECT_NE(error.find(file_ + " cannot be saved"), std::string::npos) << error;
  EXPECT_NE(error.find("cannot be written (File too large)"), std::string::npos) << error;
  EXPECT_EQ(contents(file_), "old");
  EXPECT_EQ(filesInDirectory(), 1u) << "the unfinished file must be gone";
}

TEST_F(FileReplacementTest, namesAMissingDirectory) {
  EXPECT_EQ(errorOf(directory_ + "/none/target", "x"), directory_ + "/none/target cannot be saved: there is no directory " + directory_ + "/none");
  replaceFile(file_, "x");
  EXPECT_EQ(errorOf(file_ + "/target", "x"), file_ + "/target cannot be saved: there is no directory " + file_);
}

TEST_F(FileReplacementTest, doesNotReplaceADirectory) {
  std::filesystem::create_directory(file_);
  EXPECT_EQ(errorOf(file_, "x"), file_ + " cannot be saved: it is a directory");
  EXPECT_EQ(filesInDirectory(), 1u);
}

TEST_F(FileReplacementTest, leavesOneCompleteFileWhenThreadsCompete) {
  std::vector<std::thread> writers;
  for (char c = 'a'; c < 'e'; ++c) {
    writers.emplace_back([this, c] {
      for (int i = 0; i < 20; ++i) replaceFile(file_, std::string(20000, c));
    });
  }
  for (std::thread& writer : writers) writer.join();
  const std::string text = contents(file_);
  ASSERT_EQ(text.size(), 20000u);
  EXPECT_EQ(text, std::string(20000, text[0]));
  EXPECT_EQ(filesInDirectory(), 1u);
}

}  // namespace
}  // namespace heerk_rotor
