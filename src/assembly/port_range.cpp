#include "heerk_rotor/assembly/port_range.hpp"

#include <stdexcept>

namespace heerk_rotor {

std::string localName(const std::string& name) { return name.substr(name.rfind('.') + 1); }

PortRange findPort(const CoupledSystem& system, const std::string& viewer, const std::string& quantity, Index size) {
  PortRange range;
  std::string owner;
  for (const CoupledSystem::Output& output : system.outputs()) {
    if (localName(output.name) != quantity) continue;
    if (range.present()) throw std::invalid_argument(viewer + ": both " + owner + " and " + output.name + " offer " + quantity + "; one subsystem must");
    if (size > 0 && output.size != size)
      throw std::invalid_argument(viewer + ": " + output.name + " has " + std::to_string(output.size) + " entries, expected " + std::to_string(size));
    range = {output.begin, output.size};
    owner = output.name;
  }
  return range;
}

}  // namespace heerk_rotor
