#include "fe_rotor_ports.hpp"

#include "heerk_rotor/models/hub_motion.hpp"

namespace heerk_rotor {
namespace {

constexpr double kGravity = 9.80665;  // [m/s^2], of the mount that is taken when none is connected

std::vector<std::string> perBlade(const std::string& name, const std::vector<std::string>& components, int blades) {
  std::vector<std::string> names;
  for (int k = 1; k <= blades; ++k)
    for (const std::string& component : components) names.push_back(name + "_" + component + "_" + std::to_string(k));
  return names;
}

}  // namespace

std::vector<State> feRotorStates(const std::vector<std::string>& names, const std::vector<bool>& from_drive) {
  std::vector<State> list;
  for (const bool rate : {false, true})
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string name = rate ? names[i].substr(0, names[i].find('_')) + "_rate" + names[i].substr(names[i].find('_')) : names[i];
      const std::string meaning = std::string(rate ? "rate of the " : "") + "modal coordinate of mode and blade (mode shapes of unit modal mass)" + (from_drive[i] ? " plus its share of the mast's twist" : "");
      list.push_back({name, rate ? "kg^0.5 m/s" : "kg^0.5 m", meaning});
    }
  return list;
}

std::vector<InputPort> feRotorInputs(const RotorSections& s) {
  const Index n = s.blades;
  return {hubMotionInput(),
          {"mount_velocity", 6, "m/s, rad/s", "velocity of the hub and angular velocity of the mount, in hub_link", Unconnected::kDefault, {},
           {"mount_velocity_x", "mount_velocity_y", "mount_velocity_z", "mount_rate_x", "mount_rate_y", "mount_rate_z"}},
          {"pitch", n, "rad", "pitch of each blade, nose up positive", Unconnected::kDefault},
          {"pitch_rate", n, "rad/s", "time derivative of the pitch", Unconnected::kDefault},
          {"section_loads", s.portSize(4), "N, N m", "airloads of each section: force in rotating blade axes, pitching moment about the elastic axis, nose up",
           Unconnected::kDefault, {}, sectionEntryNames("section_load", {"x", "y", "z", "pitching"}, s)},
          {"hub_acceleration", 2, "rad/s^2", "angular acceleration of hub and drive relative to the mount", Unconnected::kDefault, {}, {"hub", "drive"}},
          {"mount_acceleration", 6, "m/s^2, rad/s^2", "specific force at the hub (acceleration minus gravity) and angular acceleration of the mount, in hub_link",
           Unconnected::kDefault, {0.0, 0.0, kGravity, 0.0, 0.0, 0.0},
           {"specific_force_x", "specific_force_y", "specific_force_z", "mount_acceleration_x", "mount_acceleration_y", "mount_acceleration_z"}},
          {"pitch_acceleration", n, "rad/s^2", "second time derivative of the pitch", Unconnected::kDefault},
          {"hub_gravity", 3, "m/s^2", "gravity in hub_link", Unconnected::kDefault, {0.0, 0.0, -kGravity}, {"gravity_x", "gravity_y", "gravity_z"}, {}, {}, true}};
}

std::vector<OutputPort> feRotorOutputs(const FeRotorParameters& p) {
  const RotorSections& s = p.sections;
  const Index n = s.blades;
  const std::vector<std::string> motion{"hub_motion", "mount_velocity", "pitch", "pitch_rate"};
  // Where states count from the drive, the twist of the mast is a part of every displacement.
  const auto with = [&p](std::vector<std::string> ports) {
    if (p.absolute_below > 0.0) ports.insert(ports.begin(), "hub_motion");
    return ports;
  };
  const std::vector<std::string> shape = with({"pitch"});
  std::vector<std::string> dynamics = motion;
  for (const char* port : {"section_loads", "hub_acceleration", "mount_acceleration", "pitch_acceleration"}) dynamics.push_back(port);
  std::vector<std::string> acceleration = dynamics;
  acceleration.push_back("hub_gravity");
  const double tip_speed = p.rotor_speed * s.radius;
  return {{"section_position", s.portSize(3), "m", "elastic axis at each section, in rotating blade axes", shape, 1.0, sectionEntryNames("position", {"x", "y", "z"}, s)},
          {"section_velocity", s.portSize(3), "m/s", "velocity of the elastic axis relative to the earth, in rotating blade axes", motion, tip_speed,
           sectionEntryNames("velocity", {"x", "y", "z"}, s)},
          {"section_axes", s.portSize(6), "-", "unpitched section axes, in rotating blade axes: t toward the leading edge, n normal upwards", shape, 1.0,
           sectionEntryNames("axes", {"t_x", "t_y", "t_z", "n_x", "n_y", "n_z"}, s)},
          {"section_pitch", s.portSize(1), "rad", "pitch of each section: control, built-in and elastic twist, nose up positive", shape, 0.1, sectionEntryNames("section_pitch", {""}, s)},
          {"section_pitch_rate", s.portSize(1), "rad/s", "time derivative of section_pitch", with({"pitch_rate"}), 1.0, sectionEntryNames("section_pitch_rate", {""}, s)},
          {"section_acceleration", s.portSize(3), "m/s^2", "acceleration of the elastic axis relative to the earth, in rotating blade axes", acceleration, tip_speed * p.rotor_speed,
           sectionEntryNames("acceleration", {"x", "y", "z"}, s)},
          {"rotor_force", 3, "N", "force of the rotor on the hub, in hub_link", dynamics, 1e4, {"rotor_force_x", "rotor_force_y", "rotor_force_z"}},
          {"tilting_moment", 2, "N m", "rolling and pitching moment of the rotor on the hub, in hub_link", dynamics, 1e4, {"tilting_moment_x", "tilting_moment_y"}},
          {"blade_reaction", 1, "N m", "moment of the blades on the hub about +z", dynamics, 1e4},
          {"root_load", 6 * n, "N, N m", "force and moment of each blade on the hub about its centre, in rotating blade axes", dynamics, 1e4,
           perBlade("root", {"force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z"}, s.blades)},
          {"lag", n, "rad", "in-plane displacement of each blade tip over R, lead positive", shape, 0.01, {}, true},
          {"lag_rate", n, "rad/s", "time derivative of lag", with({"pitch", "pitch_rate"}), 1.0, {}, true},
          {"flap", n, "rad", "height of each blade tip above the hub plane over R, precone included", shape, 0.01, {}, true},
          {"flap_rate", n, "rad/s", "time derivative of flap", with({"pitch", "pitch_rate"}), 1.0, {}, true},
          {"flap_acceleration", n, "rad/s^2", "second time derivative of flap", dynamics, 10.0},
          {"tip_twist", n, "rad", "elastic twist of each blade tip, nose up positive", with({}), 0.01, {}, true},
          {"blade_momentum", 3, "N s", "linear momentum of all blades relative to the earth, in hub_link", motion, 100.0, {"blade_momentum_x", "blade_momentum_y", "blade_momentum_z"}},
          {"angular_momentum", 3, "N m s", "angular momentum of all blades relative to the earth about the hub, in hub_link", motion, 1e4,
           {"angular_momentum_x", "angular_momentum_y", "angular_momentum_z"}},
          {"blade_energy", 1, "J", "kinetic and elastic energy of all blades", motion, 1e5},
          {"structural_dissipation", 1, "W", "power lost in structural damping and hinge dampers", with({}), 1e2}};
}

}  // namespace heerk_rotor
