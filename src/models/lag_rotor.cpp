#include "heerk_rotor/models/lag_rotor.hpp"

#include <cmath>

#include "heerk_rotor/core/branch_free_math.hpp"

namespace heerk_rotor {
namespace {

enum State_ { kX, kY, kLag, kXRate = 6, kYRate, kLagRate };

// Offsets into u, in the order of inputs().
enum Input_ { kAzimuth, kSpeed, kTwist, kTwistRate, kHubAcceleration, kDriveAcceleration, kForce, kMoment = 10, kThrust = 14, kRoll, kPitch, kMastTorque };

enum Output_ { kBladeReaction, kLagOut, kLagRateOut, kFuselageX, kFuselageY, kHubForce, kHubMoment, kPosition, kVelocity, kBladeMomentum, kAngularMomentum, kLagAcceleration };

}  // namespace

LagRotor::LagRotor(const LagRotorParameters& parameters, LagFormulation formulation)
    : p_(parameters), c_(parameters), absolute_(formulation == LagFormulation::kAbsoluteLag) {}

std::vector<State> LagRotor::states() const {
  std::vector<State> list{{"fuselage_x", "m", "fuselage displacement, aft positive"},
                          {"fuselage_y", "m", "fuselage displacement, to starboard positive"}};
  const std::string prefix = absolute_ ? "absolute_lag" : "lag";
  const std::string meaning = absolute_ ? "lag angle plus g times mast twist (lead positive)" : "lag angle relative to the hub, lead positive";
  for (int i = 1; i <= kLagBlades; ++i)
    list.push_back({prefix + "_" + std::to_string(i), "rad", meaning, 0.0, "lag_" + std::to_string(i)});
  list.push_back({"fuselage_x_rate", "m/s", "fuselage velocity, aft positive"});
  list.push_back({"fuselage_y_rate", "m/s", "fuselage velocity, to starboard positive"});
  for (int i = 1; i <= kLagBlades; ++i)
    list.push_back({prefix + "_rate_" + std::to_string(i), "rad/s", "rate of the " + meaning, 0.0, "lag_rate_" + std::to_string(i)});
  return list;
}

std::vector<InputPort> LagRotor::inputs() const {
  return {hubMotionInput(),
          {"hub_acceleration", 2, "rad/s^2", "angular acceleration of the hub and of the drive", Unconnected::kError, {}, {"hub", "drive"}},
          {"blade_load", 8, "N, N m", "tangential airload of each blade towards lead, then its moment about the lag hinge", Unconnected::kDefault,
           {}, {"force_1", "force_2", "force_3", "force_4", "moment_1", "moment_2", "moment_3", "moment_4"}},
          {"thrust_load", 3, "N, N m", "thrust, rolling and pitching moment of the airloads at the hub, in hub_link", Unconnected::kDefault, {}, {"thrust", "roll", "pitch"}, {}, {}, true},
          {"mast_torque", 1, "N m", "torque of the mast on the fuselage, about +z of hub_link", Unconnected::kDefault, {}, {}, {}, {}, true}};
}

std::vector<OutputPort> LagRotor::outputs() const {
  const std::vector<std::string> everything{"hub_motion", "hub_acceleration", "blade_load"};
  // In absolute-lag form the hub acceleration reaches the reaction only through the second-order terms.
  std::vector<std::string> reaction{"hub_motion", "blade_load"};
  if (!absolute_ || p_.second_order_hub_terms) reaction.push_back("hub_acceleration");
  std::vector<std::string> with_thrust = everything;
  with_thrust.push_back("thrust_load");
  const std::vector<std::string> lag = absolute_ ? std::vector<std::string>{"hub_motion"} : std::vector<std::string>{};
  const double torque = c_.coupling_inertia;  // of 1 rad/s^2 of lag acceleration
  return {{"blade_reaction", 1, "N m", "moment of the blades on the hub about +z that the hub acceleration works against", reaction, torque, {}, false},
          {"lag", kLagBlades, "rad", "lag angle of each blade relative to the hub, lead positive", lag, 0.01, {}, true},
          {"lag_rate", kLagBlades, "rad/s", "rate of the lag angle, lead positive", lag, 0.1, {}, true},
          {"fuselage_x", 1, "m", "fuselage displacement in the paper's axes, aft positive", {}, 0.01, {}, true},
          {"fuselage_y", 1, "m", "fuselage displacement in the paper's axes, to starboard positive", {}, 0.01, {}, true},
          {"hub_force", 3, "N", "force of the rotor on the fuselage at the hub, in hub_link (x forward, y left, z up)", with_thrust, 1e3, {"hub_force_x", "hub_force_y", "hub_force_z"}, true},
          {"hub_moment", 3, "N m", "moment of the rotor on the fuselage at the hub, in hub_link", {"thrust_load", "mast_torque"}, 1e3, {"hub_moment_x", "hub_moment_y", "hub_moment_z"}, true},
          {"fuselage_position", 3, "m", "base_link in odom (x forward, y left, z up)", {}, 0.01, {"position_x", "position_y", "position_z"}, false},
          {"fuselage_velocity", 3, "m/s", "velocity of base_link (x forward, y left, z up)", {}, 0.1, {"velocity_x", "velocity_y", "velocity_z"}, false},
          {"blade_momentum", 2, "N s", "linear momentum of all blades, in the paper's axes (x aft, y to starboard)", {"hub_motion"}, 100.0, {"blade_momentum_x", "blade_momentum_y"}, false},
          {"angular_momentum", 1, "N m s", "angular momentum of hub and blades about the hub, +z, first order in lag", {"hub_motion"}, 1e4, {}, false},
          {"lag_acceleration", kLagBlades, "rad/s^2", "second derivative of the lag angle relative to the hub", everything, 1.0, {}, false}};
}

double LagRotor::lagAngle(const In& x, const In& u, int i) const noexcept { return absolute_ ? x[kLag + i] - c_.g * u[kTwist] : x[kLag + i]; }
double LagRotor::lagRate(const In& x, const In& u, int i) const noexcept { return absolute_ ? x[kLagRate + i] - c_.g * u[kTwistRate] : x[kLagRate + i]; }

/// What accelerates a blade about its hinge apart from the hub's motion: springs, damper, airload.
double LagRotor::hingeAcceleration(const In& x, const In& u, int i) const noexcept {
  return c_.load * u[kMoment + i] - (c_.r_a2 * u[kSpeed] * u[kSpeed] + c_.spring[i]) * lagAngle(x, u, i) - c_.damper[i] * lagRate(x, u, i);
}

LagRotor::Accelerations LagRotor::accelerations(const In& x, const In& u) const noexcept {
  Accelerations a;
  const SineCosine azimuth = sineCosine(u[kAzimuth]);
  a.sine = azimuth.sine;
  a.cosine = azimuth.cosine;
  const double s = a.sine, c = a.cosine, omega = u[kSpeed], alpha = u[kHubAcceleration];
  const double base = absolute_ ? u[kDriveAcceleration] : alpha;  // angular acceleration of what the states are relative to

  // Blades 1, 3 and 2, 4 are opposite, so sums over s_i and c_i are differences of two; common parts (alpha, twist) cancel.
  double lag[kLagBlades], rate[kLagBlades];
  for (int i = 0; i < kLagBlades; ++i) {
    lag[i] = lagAngle(x, u, i);
    rate[i] = lagRate(x, u, i);
    a.lag[i] = hingeAcceleration(x, u, i) - c_.g * base;
  }
  const double lag13 = lag[0] - lag[2], lag24 = lag[1] - lag[3], rate13 = rate[0] - rate[2], rate24 = rate[1] - rate[3];
  const double acc13 = a.lag[0] - a.lag[2], acc24 = a.lag[1] - a.lag[3];
  const double force13 = u[kForce] - u[kForce + 2], force24 = u[kForce + 1] - u[kForce + 3];
  // sum s_i v_i = s v13 + c v24, sum c_i v_i = c v13 - s v24
  const double sin_lag = s * lag13 + c * lag24, cos_lag = c * lag13 - s * lag24;
  const double sin_rate = s * rate13 + c * rate24, cos_rate = c * rate13 - s * rate24;
  const double sin_acc = s * acc13 + c * acc24, cos_acc = c * acc13 - s * acc24;
  const double sin_force = s * force13 + c * force24, cos_force = c * force13 - s * force24;

  // Fuselage rows with phi_i'' eliminated: sum s_i^2 = sum c_i^2 = 2 and sum s_i c_i = 0 for four blades.
  const double rhs_x = -c_.per_mass_x * sin_force - c_.damping_x * x[kXRate] - c_.spring_x * x[kX] +
                       c_.r_mx * (sin_acc + 2.0 * omega * cos_rate - omega * omega * sin_lag + alpha * cos_lag);
  const double rhs_y = c_.per_mass_y * cos_force - c_.damping_y * x[kYRate] - c_.spring_y * x[kY] -
                       c_.r_my * (cos_acc - 2.0 * omega * sin_rate - omega * omega * cos_lag - alpha * sin_lag);
  a.x = c_.gain_x * rhs_x;
  a.y = c_.gain_y * rhs_y;

  const double along_13 = c_.r_b * (s * a.x - c * a.y), along_24 = c_.r_b * (c * a.x + s * a.y);
  a.lag[0] += along_13;
  a.lag[1] += along_24;
  a.lag[2] -= along_13;
  a.lag[3] -= along_24;
  return a;
}

double LagRotor::bladeReaction(const In& x, const In& u) const noexcept {
  // Fuselage terms cancel in sum phi_i'', so the accelerations about the hinge are enough; in absolute-lag form the drive's
  // acceleration cancels as well, chi_i'' + g psi_drive'' being free of it.
  double sum = 0.0, airload = 0.0, lag_times_rate = 0.0;
  for (int i = 0; i < kLagBlades; ++i) {
    sum += hingeAcceleration(x, u, i);
    airload += u[kMoment + i] + p_.hinge_offset * u[kForce + i];
    lag_times_rate += lagAngle(x, u, i) * lagRate(x, u, i);
  }
  if (!absolute_) sum -= kLagBlades * c_.g * u[kHubAcceleration];
  double reaction = airload - c_.coupling_inertia * sum;
  if (p_.second_order_hub_terms) {
    const Accelerations a = accelerations(x, u);
    const double lag13 = lagAngle(x, u, 0) - lagAngle(x, u, 2), lag24 = lagAngle(x, u, 1) - lagAngle(x, u, 3);
    const double sin_lag = a.sine * lag13 + a.cosine * lag24, cos_lag = a.cosine * lag13 - a.sine * lag24;
    reaction += c_.static_moment * (2.0 * p_.hinge_offset * u[kSpeed] * lag_times_rate + a.x * cos_lag + a.y * sin_lag);
  }
  return reaction;
}

bool LagRotor::outputJacobian(Index port, double, const In& x, const In& u, Eigen::Map<Matrix> jacobian) noexcept {
  if (port != kBladeReaction || p_.second_order_hub_terms) return false;
  const double relative_to_drive = absolute_ ? c_.g : 0.0;  // d(lag angle) / d(twist) = -g
  jacobian.setZero();
  for (int i = 0; i < kLagBlades; ++i) {
    const double k = c_.r_a2 * u[kSpeed] * u[kSpeed] + c_.spring[i];
    jacobian(0, kSpeed) += 2.0 * c_.coupling_inertia * c_.r_a2 * u[kSpeed] * lagAngle(x, u, i);
    jacobian(0, kTwist) -= c_.coupling_inertia * k * relative_to_drive;
    jacobian(0, kTwistRate) -= c_.coupling_inertia * c_.damper[i] * relative_to_drive;
    jacobian(0, kForce + i) = p_.hinge_offset;
    jacobian(0, kMoment + i) = 1.0 - c_.coupling_inertia / c_.lag_inertia;
  }
  if (!absolute_) jacobian(0, kHubAcceleration) = kLagBlades * c_.coupling_inertia * c_.g;
  return true;
}

void LagRotor::hubForce(const In& x, const In& u, Out& y) const noexcept {
  const Accelerations a = accelerations(x, u);
  const double force_x = p_.fuselage_mass_x * a.x + p_.fuselage_damping_x * x[kXRate] + c_.mass_x * c_.spring_x * x[kX];
  const double force_y = p_.fuselage_mass_y * a.y + p_.fuselage_damping_y * x[kYRate] + c_.mass_y * c_.spring_y * x[kY];
  y << -force_x, -force_y, u[kThrust];  // the paper's x points aft and y to starboard
}

void LagRotor::bladeMomentum(const In& x, const In& u, Out& y) const noexcept {
  const auto [s, c] = sineCosine(u[kAzimuth]);
  const double omega = u[kSpeed];
  const double lag13 = lagAngle(x, u, 0) - lagAngle(x, u, 2), lag24 = lagAngle(x, u, 1) - lagAngle(x, u, 3);
  const double rate13 = lagRate(x, u, 0) - lagRate(x, u, 2), rate24 = lagRate(x, u, 1) - lagRate(x, u, 3);
  // d/dt sum phi_i e_t,i with e_t = (-s_i, c_i) and e_t' = -omega e_r
  const double along_x = -(s * rate13 + c * rate24) - omega * (c * lag13 - s * lag24);
  const double along_y = (c * rate13 - s * rate24) - omega * (s * lag13 + c * lag24);
  y << kLagBlades * p_.blade_mass * x[kXRate] + c_.static_moment * along_x, kLagBlades * p_.blade_mass * x[kYRate] + c_.static_moment * along_y;
}

void LagRotor::evalOutput(Index port, double, const In& x, const In& u, Out y) noexcept {
  switch (port) {
    case kBladeReaction: y[0] = bladeReaction(x, u); break;
    case kLagOut: for (int i = 0; i < kLagBlades; ++i) y[i] = lagAngle(x, u, i); break;
    case kLagRateOut: for (int i = 0; i < kLagBlades; ++i) y[i] = lagRate(x, u, i); break;
    case kFuselageX: y[0] = x[kX]; break;
    case kFuselageY: y[0] = x[kY]; break;
    case kHubForce: hubForce(x, u, y); break;
    case kHubMoment: y << u[kRoll], u[kPitch], u[kMastTorque]; break;
    case kPosition: y << -x[kX], -x[kY], 0.0; break;
    case kVelocity: y << -x[kXRate], -x[kYRate], 0.0; break;
    case kBladeMomentum: bladeMomentum(x, u, y); break;
    case kAngularMomentum:
      y[0] = c_.hub_inertia * u[kSpeed];
      for (int i = 0; i < kLagBlades; ++i) y[0] += c_.coupling_inertia * lagRate(x, u, i);
      break;
    case kLagAcceleration: {
      const Accelerations a = accelerations(x, u);
      const double twist_part = absolute_ ? c_.g * (u[kHubAcceleration] - u[kDriveAcceleration]) : 0.0;
      for (int i = 0; i < kLagBlades; ++i) y[i] = a.lag[i] - twist_part;
      break;
    }
  }
}

/// Flat: accelerations() hands over nine numbers, which in a call go through memory.
[[gnu::flatten]] void LagRotor::evalDerivatives(double, const In& x, const In& u, Out xdot) noexcept {
  const Accelerations a = accelerations(x, u);
  for (int i = 0; i < kXRate; ++i) xdot[i] = x[kXRate + i];
  xdot[kXRate] = a.x;
  xdot[kYRate] = a.y;
  for (int i = 0; i < kLagBlades; ++i) xdot[kLagRate + i] = a.lag[i];
}

void LagRotor::completeInitialState(const In& u, Out x) const {
  if (!absolute_) return;
  for (int i = 0; i < kLagBlades; ++i) {  // given are the angles relative to the hub
    x[kLag + i] += c_.g * u[kTwist];
    x[kLagRate + i] += c_.g * u[kTwistRate];
  }
}

}  // namespace heerk_rotor
