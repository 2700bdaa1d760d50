#include "heerk_rotor/models/drive.hpp"

#include <algorithm>
#include <cmath>

#include "model_factories.hpp"

namespace heerk_rotor {
namespace {
enum State_ { kAngle, kRate, kDemand };
}

std::vector<State> Drive::states() const {
  return {{"angle", "rad", "drive angle minus Omega t"},
          {"rate", "rad/s", "drive speed minus Omega"},
          {"demand", "rad/s^2", "acceleration asked for, before the limit"}};
}

std::vector<InputPort> Drive::inputs() const {
  return {{"speed_command", 1, "rad/s", "rotor speed asked for", Unconnected::kCommand, {p_.rotor_speed}, {"speed"}, {p_.min_speed}, {p_.max_speed}}};
}

std::vector<OutputPort> Drive::outputs() const {
  return {{"drive", 3, "rad, rad/s, rad/s^2", "angle, rate and acceleration of the drive relative to Omega t", {}, 1.0, {"drive_angle", "drive_rate", "drive_acceleration"}, false, {"rad", "rad/s", "rad/s^2"}}};
}

void Drive::evalOutput(Index, double, const In& x, const In&, Out y) noexcept {
  y << x[kAngle], x[kRate], p_.max_acceleration * std::tanh(x[kDemand] / p_.max_acceleration);
}

void Drive::evalDerivatives(double, const In& x, const In& u, Out xdot) noexcept {
  const double command = std::clamp(u[0], p_.min_speed, p_.max_speed);
  xdot[kAngle] = x[kRate];
  xdot[kRate] = p_.max_acceleration * std::tanh(x[kDemand] / p_.max_acceleration);
  xdot[kDemand] = p_.frequency * p_.frequency * (command - p_.rotor_speed - x[kRate]) - 2.0 * p_.damping_ratio * p_.frequency * x[kDemand];
}

Made makeDrive(Section& section, const BuildContext& context) {
  Drive::Parameters p;
  p.rotor_speed = context.simulation.rotor_speed;
  p.frequency = section.number("frequency", p.frequency, "rad/s", positive());
  p.damping_ratio = section.number("damping_ratio", p.damping_ratio, "-", positive());
  p.max_acceleration = section.number("max_acceleration", p.max_acceleration, "rad/s^2", positive());
  p.min_speed = section.number("min_speed", 0.5 * p.rotor_speed, "rad/s", nonNegative());
  p.max_speed = section.number("max_speed", 1.2 * p.rotor_speed, "rad/s", {p.min_speed, 1e4, false});
  section.finish();
  return std::make_unique<Drive>(p);
}

}  // namespace heerk_rotor
