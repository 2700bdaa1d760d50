#include "heerk_rotor/tools/row_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

namespace heerk_rotor {
namespace {
constexpr std::size_t kBufferSize = 1 << 20;  // [bytes] some thousand rows per system call
}

RowFile::RowFile(const std::string& file, std::size_t longest_row)
    : descriptor_(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)), longest_row_(longest_row) {
  if (descriptor_ < 0) throw std::runtime_error(std::strerror(errno));
  buffer_.resize(std::max(kBufferSize, longest_row));
}

RowFile::~RowFile() { close(); }

char* RowFile::beginRow() noexcept {
  if (buffer_.size() - used_ < longest_row_) flush();
  return error_ == 0 ? buffer_.data() + used_ : nullptr;
}

void RowFile::write(const std::string& rows) noexcept {
  for (std::size_t begin = 0; begin < rows.size() && error_ == 0;) {
    // As many complete rows as the buffer holds; a row longer than that goes in pieces.
    std::size_t count = std::min(rows.size() - begin, buffer_.size());
    const std::size_t last = rows.rfind('\n', begin + count - 1);
    if (last != std::string::npos && last >= begin) count = last + 1 - begin;
    std::copy_n(rows.data() + begin, count, buffer_.data());
    used_ = count;
    flush();
    begin += count;
  }
}

void RowFile::flush() noexcept {
  std::size_t done = 0;
  while (error_ == 0 && done < used_) {
    const ssize_t count = ::write(descriptor_, buffer_.data() + done, used_ - done);
    if (count >= 0) done += static_cast<std::size_t>(count);
    else if (errno != EINTR) error_ = errno;
  }
  if (done < used_) {
    while (done > 0 && buffer_[done - 1] != '\n') --done;
    // Best effort: a device cannot be cut, and the error is reported in any case.
    if (::ftruncate(descriptor_, static_cast<off_t>(written_ + done)) != 0) errno = 0;
  }
  written_ += done;
  used_ = 0;
}

bool RowFile::close() noexcept {
  if (descriptor_ < 0) return error_ == 0;
  if (error_ == 0) flush();
  // Network file systems report a full disk only here.
  if (::close(descriptor_) != 0 && error_ == 0) error_ = errno;
  descriptor_ = -1;
  return error_ == 0;
}

}  // namespace heerk_rotor
