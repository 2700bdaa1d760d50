#include "heerk_rotor/config/problems.hpp"

namespace heerk_rotor {

std::string Problems::text() const {
  std::string lines;
  for (const Problem& problem : list_) {
    if (!lines.empty()) lines += '\n';
    lines += problem.where + ": ";
    if (!problem.key.empty()) lines += problem.key + " = ";
    lines += (problem.found.empty() ? "(missing)" : problem.found) + ": expected " + problem.expected;
  }
  return lines;
}

ConfigurationError::ConfigurationError(const Problems& all) : std::runtime_error(all.text()), problems(all) {}

}  // namespace heerk_rotor
