#include "heerk_rotor/tools/csv_cell.hpp"

namespace heerk_rotor {

std::string csvCell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csvHeaderCell(const std::string& name, const std::string& unit) { return csvCell(name + " [" + (unit.empty() ? "-" : unit) + "]"); }

}  // namespace heerk_rotor
