#include "heerk_rotor/tools/free_space.hpp"

#include <filesystem>
#include <sstream>

#include <sys/statvfs.h>

namespace heerk_rotor {

FreeSpace::FreeSpace(const std::string& file, std::uint64_t reserve)
    : folder_(std::filesystem::absolute(file).parent_path().string()), reserve_(reserve) {}

bool FreeSpace::look() const noexcept {
  struct statvfs status;
  // A file system that cannot tell is not refused: write errors are reported in any case.
  if (::statvfs(folder_.c_str(), &status) != 0) return true;
  return static_cast<std::uint64_t>(status.f_bavail) >= reserve_ / status.f_frsize;
}

std::string FreeSpace::reason() const {
  std::ostringstream text;
  text << "less than " << static_cast<double>(reserve_) / (1024.0 * 1024.0) << " MiB left on the disk; recording ended in time to complete the file";
  return text.str();
}

}  // namespace heerk_rotor
