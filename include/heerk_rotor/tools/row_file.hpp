#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace heerk_rotor {

/// A text file written row by row through a large buffer of its own. When the disk refuses data the file is cut after
/// the last complete row, so that what is there can be read.
class RowFile {
 public:
  /// Creates or empties the file. Throws std::runtime_error with the system's reason.
  RowFile(const std::string& file, std::size_t longest_row);
  ~RowFile();
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  /// Room for one row of at most longest_row characters; nullptr after a write error.
  char* beginRow() noexcept;
  /// Takes the row that was written from beginRow() up to `end`, its newline included.
  void endRow(char* end) noexcept { used_ = static_cast<std::size_t>(end - buffer_.data()); }

  /// Brings rows of any length to the file at once, so that a reader can follow it; each ends with a newline. Only for those who use no beginRow().
  void write(const std::string& rows) noexcept;

  /// Brings all rows so far to the file.
  void flush() noexcept;
  /// Writes the rest and closes; false after any error.
  bool close() noexcept;
  /// errno of the first failure, or 0.
  int error() const noexcept { return error_; }

 private:
  int descriptor_;
  int error_ = 0;
  std::size_t longest_row_;
  std::size_t used_ = 0;
  std::uint64_t written_ = 0;  // bytes in the file, all of complete rows
  std::vector<char> buffer_;
};

}  // namespace heerk_rotor
