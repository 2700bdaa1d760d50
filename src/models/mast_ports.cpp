#include "heerk_rotor/models/mast_ports.hpp"

#include "heerk_rotor/models/mount_ports.hpp"
#include "heerk_rotor/models/registry.hpp"

namespace heerk_rotor {

std::vector<InputPort> mastInputs(MastHub hub, bool reaction_needed) {
  std::vector<InputPort> list{
      {"blade_reaction", 1, "N m", "moment of the blades on the hub about +z", reaction_needed ? Unconnected::kError : Unconnected::kDefault},
      {"drive", 3, "rad, rad/s, rad/s^2", "angle, rate and acceleration of the drive relative to Omega t", Unconnected::kDefault, {}, {"angle", "rate", "acceleration"}}};
  if (hub == MastHub::kOwn) {
    list.push_back(mountVelocityInput());
    list.push_back(mountAccelerationInput());
  }
  return list;
}

std::vector<OutputPort> mastOutputs(MastHub hub, bool elastic, double rotor_speed) {
  std::vector<std::string> acceleration{"drive"}, torque{};
  std::vector<std::string>& constrained = elastic ? acceleration : torque;  // what the blades' reaction reaches at once
  constrained.insert(constrained.begin(), "blade_reaction");
  if (!elastic) torque.push_back("drive");
  if (hub == MastHub::kOwn) constrained.push_back("mount_acceleration");

  std::vector<OutputPort> list{
      {"hub_motion", 4, "rad, rad/s", "azimuth and speed of the hub, mast twist and its rate", {"drive"}, 1.0, {"hub_azimuth", "hub_speed", "hub_twist", "hub_twist_rate"}, false, {"rad", "rad/s", "rad", "rad/s"}},
      {"hub_acceleration", 2, "rad/s^2", "angular acceleration of the hub and of the drive", acceleration, 1.0, {"hub_acceleration", "drive_acceleration"}, false},
      {"twist", 1, "rad", "hub angle minus drive angle", {}, 1e-3, {}, true},
      {"azimuth", 1, "rad", "hub angle, unwrapped; blade 1 is aft at multiples of 2 pi", {"drive"}, 1.0, {}, false},
      {"rotor_speed", 1, "rad/s", "speed of the hub", {"drive"}, rotor_speed, {}, true},
      {"torque", 1, "N m", "torque of the mast on the fuselage, about +z of hub_link", torque, 1e3, {}, true}};
  if (hub == MastHub::kOwn) {
    list.push_back({"gyroscopic_moment", 2, "N m", "moment of the spinning hub on the mount about x and y of hub_link, -omega x H", {"drive", "mount_velocity"}, 100.0,
                    {"gyroscopic_moment_x", "gyroscopic_moment_y"}, false});
    list.push_back({"hub_angular_momentum", 1, "kg m^2/s", "angular momentum of the hub about z of hub_link, relative to space", {"drive", "mount_velocity"}, 1e3, {}, false});
  }
  return list;
}

HubOnMast readHubOnMast(Section& section, const BuildContext& context) {
  const bool only_elastic_blades = context.onlySubsystemOfType("lag_rotor").empty() && !context.onlySubsystemOfType("fe_rotor").empty() && !section.has("rotor");
  if (section.has("hub_inertia") || only_elastic_blades)
    return {MastHub::kOwn, {LagFormulation::kPrinted, section.requiredNumber("hub_inertia", "kg m^2", positive()), 0.0, 0.0}, 1.0};
  const LagRotorParameters rotor = rotorOfMast(section, context);
  return {MastHub::kOfLagRotor, mastLoad(rotor, formulationOf(context), context.simulation.rotor_speed), LagRotorConstants(rotor).kappa};
}

}  // namespace heerk_rotor
