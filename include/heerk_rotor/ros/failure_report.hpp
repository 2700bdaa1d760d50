#pragma once
#include <string>
#include <vector>

#include "heerk_rotor/realtime/instant.hpp"

namespace heerk_rotor {

/// Writes the instants before a failed step as CSV: one header line with cells `name [unit]`, 17 significant digits.
/// Throws std::runtime_error that names the file and the reason.
void writeFailureHistory(const std::string& file, const std::vector<RotorInstant>& history);
void writeFailureHistory(const std::string& file, const std::vector<ShaftInstant>& history);

}  // namespace heerk_rotor
