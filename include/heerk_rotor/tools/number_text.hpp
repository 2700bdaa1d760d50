#pragma once
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <string>

namespace heerk_rotor {

/// Longest text of a number: sign, 17 digits, point, e-308.
constexpr std::size_t kLongestNumber = 32;

/// Writes `value` as printf's %.17g does in the C locale, which reads back bit by bit. Needs kLongestNumber characters
/// at `begin`; returns the end of the text.
inline char* writeNumber(char* begin, double value) noexcept {
#if defined(__cpp_lib_to_chars)
  return std::to_chars(begin, begin + kLongestNumber, value, std::chars_format::general, 17).ptr;
#else  // GCC before 11 has no std::to_chars for double
  return begin + std::snprintf(begin, kLongestNumber, "%.17g", value);
#endif
}

inline char* writeNumber(char* begin, std::uint64_t value) noexcept {
  return std::to_chars(begin, begin + kLongestNumber, value).ptr;
}

/// The same as a string; double or std::uint64_t.
template <class Number>
std::string numberText(Number value) {
  char buffer[kLongestNumber];
  return std::string(buffer, writeNumber(buffer, value));
}

}  // namespace heerk_rotor
