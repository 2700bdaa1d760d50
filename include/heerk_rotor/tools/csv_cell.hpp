#pragma once
#include <string>

namespace heerk_rotor {

/// One cell of a CSV line: in double quotes, quotes within doubled, where it holds a comma, a quote or a line break.
std::string csvCell(const std::string& text);

/// A cell of a header line, "name [unit]"; "-" for no unit. Units of ports of forces and moments have a comma: "N, N m".
std::string csvHeaderCell(const std::string& name, const std::string& unit);

}  // namespace heerk_rotor
