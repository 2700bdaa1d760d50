#include "heerk_rotor/ros/rotor_geometry.hpp"

#include "heerk_rotor/config/section.hpp"
#include "heerk_rotor/models/swashplate.hpp"

namespace heerk_rotor {

RotorGeometry readRotorGeometry(const Configuration& configuration) {
  // The simulation has been built from this configuration, so there are no problems left to report.
  Problems ignored;
  RotorGeometry geometry;
  const auto find = [&](const char* key, double fallback) {
    for (const auto& entry : configuration.root()["subsystems"]) {
      Section section(configuration, "subsystems." + entry.first.as<std::string>(), ignored);
      if (section.has(key)) return section.number(key, fallback, "m");
    }
    return fallback;
  };
  geometry.hinge_offset = find("hinge_offset", geometry.hinge_offset);
  geometry.radius = find("radius", geometry.hinge_offset + 2.0 * find("blade_length", 2.5));
  geometry.root_cutout = find("root_cutout", 0.16 * geometry.radius);
  geometry.chord = find("chord", geometry.radius / 16.0);
  return geometry;
}

CommandLimits readCommandLimits(const Configuration& configuration, const CoupledSystem& system, const RotorView& view) {
  const Swashplate::Parameters defaults;
  CommandLimits limits{defaults.collective_min, defaults.collective_max, defaults.cyclic_limit};
  if (!view.hasSwashplate()) return limits;
  const std::string& command = system.commandNames()[static_cast<std::size_t>(view.collectiveCommand())];
  Problems ignored;
  Section section(configuration, "subsystems." + command.substr(0, command.rfind('.')), ignored);
  limits.collective_min = section.number("collective_min", limits.collective_min, "rad");
  limits.collective_max = section.number("collective_max", limits.collective_max, "rad");
  limits.cyclic_limit = section.number("cyclic_limit", limits.cyclic_limit, "rad");
  return limits;
}

}  // namespace heerk_rotor
