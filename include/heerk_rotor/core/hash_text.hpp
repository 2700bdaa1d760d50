#pragma once
#include <cstdint>
#include <cstdio>
#include <string>

namespace heerk_rotor {

/// A 64-bit hash as 16 hexadecimal digits.
inline std::string hashText(std::uint64_t hash) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

}  // namespace heerk_rotor
