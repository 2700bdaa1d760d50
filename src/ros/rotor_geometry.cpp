#include "heerk_rotor/ros/rotor_geometry.hpp"

#include "heerk_rotor/config/section.hpp"
#include "heerk_rotor/models/blade_polars.hpp"
#include "heerk_rotor/models/rotor_sections.hpp"
#include "heerk_rotor/models/swashplate.hpp"

namespace heerk_rotor {

namespace {

/// The first subsystem that gives a key, or the last one that there is: its fallback is as good as any other's.
Section sectionWith(const Configuration& configuration, const char* key, Problems& problems) {
  std::string path = "subsystems.none";
  for (const auto& entry : configuration.root()["subsystems"]) {
    path = "subsystems." + entry.first.as<std::string>();
    if (Section(configuration, path, problems).has(key)) break;
  }
  return Section(configuration, path, problems);
}

void readElasticBlades(Section& rotor, Section& airloads, RotorGeometry& geometry) {
  const RotorSections sections = readRotorSections(rotor);
  std::vector<double> parts;  // of the radius
  for (const double r : sections.r) parts.push_back(r / sections.radius);
  const std::vector<double> chord = readChord(airloads, parts);
  for (std::size_t i = 0; i < parts.size(); ++i) geometry.sections.push_back({sections.width[i], chord[i]});
  geometry.radius = sections.radius;
  geometry.root_cutout = sections.r.front() - 0.5 * sections.width.front();
  geometry.chord = chord.back();
  geometry.hinge_offset = 0.0;  // flap and lag are those of a blade hinged at the centre
}

}  // namespace

RotorGeometry readRotorGeometry(const Configuration& configuration) {
  // The simulation has been built from this configuration, so there are no problems left to report.
  Problems ignored;
  RotorGeometry geometry;
  const auto find = [&](const char* key, double fallback) { return sectionWith(configuration, key, ignored).number(key, fallback, "m"); };
  geometry.clockwise = sectionWith(configuration, "rotation", ignored).word("rotation", "ccw") == "cw";
  Section rotor = sectionWith(configuration, "nodes", ignored), airloads = sectionWith(configuration, "chord", ignored);
  if (rotor.word("type", "") == "fe_rotor") {
    readElasticBlades(rotor, airloads, geometry);
    return geometry;
  }
  geometry.hinge_offset = find("hinge_offset", geometry.hinge_offset);
  geometry.radius = find("radius", geometry.hinge_offset + 2.0 * find("blade_length", 2.5));
  geometry.root_cutout = find("root_cutout", 0.16 * geometry.radius);
  geometry.chord = find("chord", geometry.radius / 16.0);
  return geometry;
}

CommandLimits readCommandLimits(const Configuration& configuration, const CoupledSystem& system, const CommandView& commands) {
  const Swashplate::Parameters defaults;
  CommandLimits limits{defaults.collective_min, defaults.collective_max, defaults.cyclic_limit};
  if (!commands.hasSwashplate()) return limits;
  const std::string& command = system.commandNames()[static_cast<std::size_t>(commands.collective())];
  Problems ignored;
  Section section(configuration, "subsystems." + command.substr(0, command.rfind('.')), ignored);
  limits.collective_min = section.number("collective_min", limits.collective_min, "rad");
  limits.collective_max = section.number("collective_max", limits.collective_max, "rad");
  limits.cyclic_limit = section.number("cyclic_limit", limits.cyclic_limit, "rad");
  return limits;
}

}  // namespace heerk_rotor
