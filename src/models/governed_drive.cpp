#include "heerk_rotor/models/governed_drive.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "heerk_rotor/models/mount_ports.hpp"
#include "model_factories.hpp"

namespace heerk_rotor {
namespace {

enum State_ { kAngle, kRate, kIntegral };
// The speed command comes last, because without governor it is absent.
enum Input_ { kMastTorque, kRollRate = 4, kPitchingRate, kYawRate, kYawAcceleration = 12, kSpeedCommand };
enum Output_ { kDrive, kTorque, kEngineTorque, kGyroscopicMoment, kAngularMomentum };

}  // namespace

GovernedDrive::GovernedDrive(const Parameters& parameters) : p_(parameters) {
  centre_ = 0.5 * (p_.max_torque + p_.min_torque);
  span_ = 0.5 * (p_.max_torque - p_.min_torque);
  const double trim = (p_.engine_torque - centre_) / span_;
  if (p_.governor && !(std::abs(trim) < 1.0)) throw std::invalid_argument("engine_torque must lie between min_torque and max_torque");
  offset_ = std::atanh(trim);
  slope_at_trim_ = 1.0 - trim * trim;
}

std::vector<State> GovernedDrive::states() const {
  std::vector<State> list{{"angle", "rad", "drive angle minus Omega t"}, {"rate", "rad/s", "drive speed minus Omega"}};
  if (p_.governor) list.push_back({"integral", "N m", "torque that the governor has added by integrating the speed error"});
  return list;
}

std::vector<std::string> GovernedDrive::ignoredInitialValues() const {
  return p_.governor ? std::vector<std::string>{} : std::vector<std::string>{"integral"};
}

std::vector<InputPort> GovernedDrive::inputs() const {
  std::vector<InputPort> list{{"mast_torque", 1, "N m", "torque of the mast on the drive, about +z of hub_link"}, mountVelocityInput(), mountAccelerationInput()};
  if (p_.governor)
    list.push_back({"speed_command", 1, "rad/s", "rotor speed asked for", Unconnected::kCommand, {p_.rotor_speed}, {"speed"}, {p_.min_speed}, {p_.max_speed}});
  return list;
}

std::vector<OutputPort> GovernedDrive::outputs() const {
  const auto withCommand = [this](std::vector<std::string> list) {
    if (p_.governor) list.push_back("speed_command");
    return list;
  };
  return {{"drive", 3, "rad, rad/s, rad/s^2", "angle, rate and acceleration of the drive relative to Omega t", withCommand({"mast_torque", "mount_acceleration"}), 1.0,
           {"drive_angle", "drive_rate", "drive_acceleration"}, false, {"rad", "rad/s", "rad/s^2"}},
          {"torque", 1, "N m", "torque of the engine on the fuselage, about +z of hub_link", withCommand({}), 1e3, {}, false},
          {"engine_torque", 1, "N m", "torque of the engine on the drive, about +z of hub_link", withCommand({}), 1e3, {}, true},
          {"gyroscopic_moment", 2, "N m", "moment of the spinning drive on the mount about x and y of hub_link, -omega x H", {"mount_velocity"}, 100.0,
           {"gyroscopic_moment_x", "gyroscopic_moment_y"}, false},
          {"drive_angular_momentum", 1, "kg m^2/s", "angular momentum of the drive about z of hub_link, relative to space", {"mount_velocity"}, 1e3, {}, false}};
}

double GovernedDrive::speedError(const In& x, const In& u) const noexcept {
  return std::clamp(u[kSpeedCommand], p_.min_speed, p_.max_speed) - p_.rotor_speed - x[kRate];
}

double GovernedDrive::engineTorque(const In& x, const In& u, double& slope) const noexcept {
  slope = 0.0;
  if (!p_.governor) return p_.engine_torque;
  const double demand = p_.proportional_gain * speedError(x, u) + x[kIntegral];
  const double saturation = std::tanh(demand / (slope_at_trim_ * span_) + offset_);
  slope = (1.0 - saturation * saturation) / slope_at_trim_;
  return centre_ + span_ * saturation;
}

double GovernedDrive::acceleration(const In& x, const In& u) const noexcept {
  double slope;
  return (engineTorque(x, u, slope) + u[kMastTorque]) / p_.inertia - u[kYawAcceleration];
}

double GovernedDrive::angularMomentum(const In& x, const In& u) const noexcept { return p_.inertia * (p_.rotor_speed + x[kRate] + u[kYawRate]); }

void GovernedDrive::evalOutput(Index port, double, const In& x, const In& u, Out y) noexcept {
  double slope;
  switch (port) {
    case kDrive: y << x[kAngle], x[kRate], acceleration(x, u); break;
    case kTorque: y[0] = -engineTorque(x, u, slope); break;
    case kEngineTorque: y[0] = engineTorque(x, u, slope); break;
    case kGyroscopicMoment: y << -u[kPitchingRate] * angularMomentum(x, u), u[kRollRate] * angularMomentum(x, u); break;
    case kAngularMomentum: y[0] = angularMomentum(x, u); break;
  }
}

bool GovernedDrive::outputJacobian(Index port, double, const In& x, const In& u, Eigen::Map<Matrix> jacobian) noexcept {
  if (port != kDrive) return false;  // the others read nothing that is in a loop
  jacobian(2, kMastTorque) = 1.0 / p_.inertia;
  jacobian(2, kYawAcceleration) = -1.0;
  if (p_.governor && u[kSpeedCommand] > p_.min_speed && u[kSpeedCommand] < p_.max_speed) {
    double slope;
    engineTorque(x, u, slope);
    jacobian(2, kSpeedCommand) = slope * p_.proportional_gain / p_.inertia;
  }
  return true;
}

void GovernedDrive::evalDerivatives(double, const In& x, const In& u, Out xdot) noexcept {
  xdot[kAngle] = x[kRate];
  xdot[kRate] = acceleration(x, u);
  if (!p_.governor) return;
  double slope;
  engineTorque(x, u, slope);
  xdot[kIntegral] = p_.integral_gain * speedError(x, u) * slope;
}

Made makeGovernedDrive(Section& section, const BuildContext& context) {
  GovernedDrive::Parameters p;
  p.rotor_speed = context.simulation.rotor_speed;
  p.inertia = section.number("inertia", p.inertia, "kg m^2", positive());
  p.governor = section.flag("governor", p.governor);
  p.proportional_gain = section.number("proportional_gain", p.proportional_gain, "N m s/rad", nonNegative());
  p.integral_gain = section.number("integral_gain", p.integral_gain, "N m/rad", nonNegative());
  p.min_torque = section.number("min_torque", p.min_torque, "N m");
  p.max_torque = section.number("max_torque", std::max(p.max_torque, p.min_torque + 1.0), "N m", {p.min_torque, 1e9, true});
  // Without governor any torque is allowed, and 0 (autorotation) is the natural one.
  const double middle = 0.5 * (p.min_torque + p.max_torque);
  p.engine_torque = section.number("engine_torque", p.governor ? middle : 0.0, "N m", p.governor ? Range{p.min_torque, p.max_torque, true} : anyNumber());
  p.min_speed = section.number("min_speed", 0.5 * p.rotor_speed, "rad/s", nonNegative());
  p.max_speed = section.number("max_speed", 1.2 * p.rotor_speed, "rad/s", {p.min_speed, 1e4, false});
  section.finish();
  if (p.governor && p.engine_torque >= p.max_torque) {
    section.problem("engine_torque", "a number below max_torque [N m], which a smooth limit reaches only in the limit");
    return nullptr;
  }
  return std::make_unique<GovernedDrive>(p);
}

}  // namespace heerk_rotor
