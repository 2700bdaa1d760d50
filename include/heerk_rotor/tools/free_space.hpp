#pragma once
#include <cstdint>
#include <string>

namespace heerk_rotor {

/// Watches the room left on the file system of a file. Formats whose index or last record is written at the end need it:
/// recording stops while there is still room to complete the file.
class FreeSpace {
 public:
  /// `reserve` [bytes] must stay free.
  FreeSpace(const std::string& file, std::uint64_t reserve);

  /// Looks at every 256th call (one system call per about 400 kB of messages), and at the first one.
  bool enough() noexcept { return calls_++ % 256 != 0 || look(); }

  /// "less than 16 MiB left on the disk; recording ended in time to complete the file"
  std::string reason() const;

 private:
  bool look() const noexcept;
  std::string folder_;
  std::uint64_t reserve_;
  std::uint64_t calls_ = 0;
};

}  // namespace heerk_rotor
