#include "heerk_rotor/models/elastic_mast.hpp"

#include <cmath>

namespace heerk_rotor {
namespace {

enum State_ { kTwist, kTwistRate };
enum Input_ { kReaction, kDriveAngle, kDriveRate, kDriveAcceleration };
enum Output_ { kHubMotion, kHubAcceleration, kTwistOut, kAzimuth, kSpeed, kTorque };

std::vector<InputPort> mastInputs(bool reaction_needed) {
  return {{"blade_reaction", 1, "N m", "moment of the blades on the hub about +z", reaction_needed ? Unconnected::kError : Unconnected::kDefault},
          {"drive", 3, "rad, rad/s, rad/s^2", "angle, rate and acceleration of the drive relative to Omega t", Unconnected::kDefault, {}, {"angle", "rate", "acceleration"}}};
}

std::vector<OutputPort> mastOutputs(bool elastic, double rotor_speed) {
  const std::vector<std::string> acceleration = elastic ? std::vector<std::string>{"blade_reaction", "drive"} : std::vector<std::string>{"drive"};
  const std::vector<std::string> torque = elastic ? std::vector<std::string>{} : std::vector<std::string>{"blade_reaction", "drive"};
  return {{"hub_motion", 4, "rad, rad/s", "azimuth and speed of the hub, mast twist and its rate", {"drive"}, 1.0, {"hub_azimuth", "hub_speed", "hub_twist", "hub_twist_rate"}, false, {"rad", "rad/s", "rad", "rad/s"}},
          {"hub_acceleration", 2, "rad/s^2", "angular acceleration of the hub and of the drive", acceleration, 1.0, {"hub_acceleration", "drive_acceleration"}, false},
          {"twist", 1, "rad", "hub angle minus drive angle", {}, 1e-3, {}, true},
          {"azimuth", 1, "rad", "hub angle, unwrapped; blade 1 is aft at multiples of 2 pi", {"drive"}, 1.0, {}, false},
          {"rotor_speed", 1, "rad/s", "speed of the hub", {"drive"}, rotor_speed, {}, true},
          {"torque", 1, "N m", "torque of the mast on the fuselage, about +z of hub_link", torque, 1e3, {}, true}};
}

}  // namespace

ElasticMast::ElasticMast(const Parameters& parameters, const MastLoad& load) : p_(parameters), load_(load) {}

std::vector<State> ElasticMast::states() const {
  return {{"twist", "rad", "hub angle minus drive angle"}, {"twist_rate", "rad/s", "rate of the twist"}};
}

std::vector<InputPort> ElasticMast::inputs() const { return mastInputs(true); }
std::vector<OutputPort> ElasticMast::outputs() const { return mastOutputs(true, p_.rotor_speed); }

StiffPart ElasticMast::stiffPart() const {
  ModalStiff part;
  part.omega = Vector::Constant(1, std::sqrt((p_.stiffness + load_.stiffness) / load_.inertia));
  part.damping = Vector::Constant(1, (p_.damping + load_.damping) / load_.inertia);
  return part;
}

double ElasticMast::hubAcceleration(const In& x, const In& u) const noexcept {
  return (u[kReaction] - p_.stiffness * x[kTwist] - p_.damping * x[kTwistRate]) / load_.inertia;
}

void ElasticMast::evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept {
  switch (port) {
    case kHubMotion: y << p_.rotor_speed * t + u[kDriveAngle] + x[kTwist], p_.rotor_speed + u[kDriveRate] + x[kTwistRate], x[kTwist], x[kTwistRate]; break;
    case kHubAcceleration: y << hubAcceleration(x, u), u[kDriveAcceleration]; break;
    case kTwistOut: y[0] = x[kTwist]; break;
    case kAzimuth: y[0] = p_.rotor_speed * t + u[kDriveAngle] + x[kTwist]; break;
    case kSpeed: y[0] = p_.rotor_speed + u[kDriveRate] + x[kTwistRate]; break;
    case kTorque: y[0] = p_.stiffness * x[kTwist] + p_.damping * x[kTwistRate]; break;
  }
}

bool ElasticMast::outputJacobian(Index port, double, const In&, const In&, Eigen::Map<Matrix> jacobian) noexcept {
  if (port != kHubAcceleration) return false;
  jacobian(0, kReaction) = 1.0 / load_.inertia;
  jacobian(1, kDriveAcceleration) = 1.0;
  return true;
}

void ElasticMast::evalDerivatives(double, const In& x, const In& u, Out xdot) noexcept {
  xdot[kTwist] = x[kTwistRate];
  xdot[kTwistRate] = hubAcceleration(x, u) - u[kDriveAcceleration];
}

void ElasticMast::evalRemainder(double, const In& x, const In& u, Out remainder) noexcept {
  remainder[kTwist] = 0.0;
  remainder[kTwistRate] = (u[kReaction] + load_.stiffness * x[kTwist] + load_.damping * x[kTwistRate]) / load_.inertia - u[kDriveAcceleration];
}

std::vector<InputPort> RigidMast::inputs() const { return mastInputs(false); }
std::vector<OutputPort> RigidMast::outputs() const { return mastOutputs(false, rotor_speed_); }

void RigidMast::evalOutput(Index port, double t, const In&, const In& u, Out y) noexcept {
  switch (port) {
    case kHubMotion: y << rotor_speed_ * t + u[kDriveAngle], rotor_speed_ + u[kDriveRate], 0.0, 0.0; break;
    case kHubAcceleration: y << u[kDriveAcceleration], u[kDriveAcceleration]; break;
    case kTwistOut: y[0] = 0.0; break;
    case kAzimuth: y[0] = rotor_speed_ * t + u[kDriveAngle]; break;
    case kSpeed: y[0] = rotor_speed_ + u[kDriveRate]; break;
    case kTorque: y[0] = u[kReaction] - load_.inertia * u[kDriveAcceleration]; break;
  }
}

}  // namespace heerk_rotor
