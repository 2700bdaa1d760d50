#include "heerk_rotor/assembly/command_view.hpp"

#include <stdexcept>

#include "heerk_rotor/assembly/port_range.hpp"

namespace heerk_rotor {
namespace {

void fail(const std::string& what) { throw std::invalid_argument("command view: " + what); }

Index findCommand(const CoupledSystem& system, const std::string& quantity) {
  Index found = -1;
  const std::vector<std::string>& names = system.commandNames();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (localName(names[i]) != quantity) continue;
    if (found >= 0) fail("both " + names[static_cast<std::size_t>(found)] + " and " + names[i] + " take the command " + quantity);
    found = static_cast<Index>(i);
  }
  return found;
}

/// All components of a vector, or none.
std::vector<Index> findCommands(const CoupledSystem& system, const std::vector<std::string>& quantities) {
  std::vector<Index> entries;
  std::string missing;
  for (const std::string& quantity : quantities) {
    const Index entry = findCommand(system, quantity);
    if (entry < 0) missing = quantity;
    else entries.push_back(entry);
  }
  if (!missing.empty() && !entries.empty())
    fail("the system takes the command " + system.commandNames()[static_cast<std::size_t>(entries.front())] + " but none called " + missing);
  return entries;
}

}  // namespace

CommandView::CommandView(const CoupledSystem& system)
    : collective_(findCommand(system, "collective")),
      lateral_cyclic_(findCommand(system, "lateral_cyclic")),
      longitudinal_cyclic_(findCommand(system, "longitudinal_cyclic")),
      speed_(findCommands(system, {"speed"})),
      wind_(findCommands(system, {"wind_x", "wind_y", "wind_z"})),
      external_wrench_(findCommands(system, {"external_force_x", "external_force_y", "external_force_z", "external_moment_x", "external_moment_y", "external_moment_z"})) {}

}  // namespace heerk_rotor
