#pragma once
#include <string>

#include <yaml-cpp/yaml.h>

namespace heerk_rotor {

/// How single values of a configuration are found, read and shown. yaml-cpp's own conversions are not used, because they
/// take "0x10", "1_000" or ".inf" for numbers and "on" for true, which in a physical parameter are mistakes.

/// The child of a mapping by key or of a list by index ("2"); an undefined node when there is none.
YAML::Node findChild(const YAML::Node& parent, const std::string& name);

/// The value at a dotted key ("subsystems.rotor.lag_damper.2"); "" is the root itself.
YAML::Node findValue(const YAML::Node& root, const std::string& dotted_key);

/// True for a scalar in quotes: it is text, whatever it looks like.
bool isQuoted(const YAML::Node& value);

/// Reads a finite decimal number: 12, -0.5, .5, 3e6, 3.0e+6. Everything else is refused: text in quotes, hexadecimal,
/// digits with underscores, leading zeros (octal in some YAML versions), .nan, .inf, overflow. Independent of the locale.
bool readNumber(const YAML::Node& value, double& number);

/// Reads a whole decimal number without point or exponent; refuses what readNumber refuses.
bool readInteger(const YAML::Node& value, long& number);

/// The value on one line as a user wrote it, long ones shortened; "(missing)" or "(empty)" when there is none.
std::string asWritten(const YAML::Node& value);

/// The whole tree as YAML, every scalar as written, so that parsing the text gives the same tree.
std::string yamlText(const YAML::Node& root);

/// A text on one line, with at most `limit` characters.
std::string shortened(std::string text, std::size_t limit = 80);

}  // namespace heerk_rotor
