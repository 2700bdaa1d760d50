#include "smooth_airloads.hpp"

#include "heerk_rotor/config/section.hpp"
#include "heerk_rotor/models/blade_airloads.hpp"

namespace heerk_rotor::work_precision {

std::unique_ptr<SubsystemModel> makeSmoothAirloads(const Configuration& configuration, const RotorSections& sections, double rotor_speed) {
  Problems problems;
  Section section(configuration, "subsystems.airloads", problems);
  BladeAirloads::Parameters p;
  p.sections = sections;
  p.rotor_speed = rotor_speed;
  p.chord.assign(sections.r.size(), section.requiredNumber("chord", "m"));
  p.tip_loss_factor = section.requiredNumber("tip_loss_factor", "r/R");
  p.air.density = section.requiredNumber("air_density", "kg/m^3");
  p.air.speed_of_sound = section.requiredNumber("speed_of_sound", "m/s");
  if (!problems.empty()) throw ConfigurationError(problems);
  return std::make_unique<BladeAirloads>(p);
}

}  // namespace heerk_rotor::work_precision
