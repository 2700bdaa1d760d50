#pragma once
#include <gtest/gtest.h>

#include <cctype>
#include <cstdio>
#include <string>

namespace heerk_rotor::test {

/// A measured number, into the log and into the XML report.
inline void report(const std::string& name, double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.12g", value);
  std::printf("[ MEASURED ] %s = %s\n", name.c_str(), text);
  std::string key = name;
  for (char& c : key)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  testing::Test::RecordProperty(key, text);
}

}  // namespace heerk_rotor::test
