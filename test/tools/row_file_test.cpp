#include "heerk_rotor/tools/row_file.hpp"

#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include "full_disk.hpp"
#include "test_files.hpp"

namespace heerk_rotor {
namespace {

/// Rows of 8 bytes with their number; returns how many were taken.
std::size_t writeRows(RowFile& file, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    char* row = file.beginRow();
    if (row == nullptr) return i;
    const std::string text = std::to_string(1000000 + i) + "\n";
    file.endRow(std::copy(text.begin(), text.end(), row));
  }
  return count;
}

TEST(RowFile, writesAllRowsThroughManyBuffers) {
  const TestFolder folder;
  RowFile file(folder.file("rows"), 16);
  constexpr std::size_t kRows = 300000;  // 2.4 MB, more than two buffers
  EXPECT_EQ(writeRows(file, kRows), kRows);
  EXPECT_TRUE(file.close());
  const std::string text = readText(folder.file("rows"));
  ASSERT_EQ(text.size(), 8 * kRows);
  for (std::size_t i = 0; i < kRows; i += 997) ASSERT_EQ(text.substr(8 * i, 8), std::to_string(1000000 + i) + "\n");
}

TEST(RowFile, keepsOnlyCompleteRowsWhenTheDiskIsFull) {
  const TestFolder folder;
  RowFile file(folder.file("rows"), 16);
  constexpr std::size_t kLimit = 1500001;  // ends within a row of the second buffer
  std::size_t taken = 0;
  {
    const FullDisk limit(kLimit);
    taken = writeRows(file, 1000000);
    EXPECT_FALSE(file.close());
  }
  EXPECT_LT(taken, 1000000u) << "rows were taken after the error";
  EXPECT_EQ(file.error(), EFBIG) << std::strerror(file.error());
  const std::string text = readText(folder.file("rows"));
  EXPECT_EQ(text.size(), kLimit / 8 * 8);
  EXPECT_EQ(text.substr(text.size() - 8), std::to_string(1000000 + kLimit / 8 - 1) + "\n");
}

TEST(RowFile, anErrorAtTheEndIsReportedByClose) {
  const TestFolder folder;
  RowFile file(folder.file("rows"), 16);
  writeRows(file, 10);  // all still in the buffer
  const FullDisk limit(20);
  EXPECT_FALSE(file.close());
  EXPECT_EQ(readText(folder.file("rows")), "1000000\n1000001\n");
}

}  // namespace
}  // namespace heerk_rotor
