#pragma once
#include <string>

namespace heerk_rotor {

/// Puts `contents` into `file` such that at every instant, also after a crash or on a full disk, the file is the old one
/// or the complete new one: written to a temporary name beside it, flushed to the disk, renamed.
/// Throws std::runtime_error that names both files and the system's reason; nothing is left behind then.
void replaceFile(const std::string& file, const std::string& contents);

}  // namespace heerk_rotor
