#include "heerk_rotor/models/rigid_body_mount.hpp"

#include <Eigen/LU>

namespace heerk_rotor {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {
enum State_ { kPosition, kOrientation = 3, kVelocity = 7, kRates = 10 };
}

RigidBodyMount::RigidBodyMount(const MountParameters& parameters) : Mount(parameters), inverse_inertia_(parameters.inertia.inverse()) {
  if (p_.mode == MountMode::kSpring6) gear_.emplace(p_);
  setLoadGain(Matrix3d::Identity() / p_.mass, inverse_inertia_);
}

std::vector<State> RigidBodyMount::states() const {
  const char* const axes[] = {"x", "y", "z"};
  const double vector_part[] = {p_.orientation.x(), p_.orientation.y(), p_.orientation.z()};
  std::vector<State> list;
  for (const char* axis : axes) list.push_back({std::string("position_") + axis, "m", std::string("centre of gravity along ") + axis + " of odom"});
  list.push_back({"orientation_w", "-", "scalar part of the quaternion from base_link to odom", p_.orientation.w()});
  for (int i = 0; i < 3; ++i)
    list.push_back({std::string("orientation_") + axes[i], "-", std::string("vector part of the quaternion, ") + axes[i], vector_part[i]});
  for (const char* axis : axes) list.push_back({std::string("velocity_") + axis, "m/s", std::string("velocity over ground along ") + axis + " of base_link"});
  for (const char* axis : axes) list.push_back({std::string("rate_") + axis, "rad/s", std::string("angular velocity about ") + axis + " of base_link"});
  return list;
}

void RigidBodyMount::completeInitialState(const In&, Out x) const {
  x.segment<4>(kOrientation) /= x.segment<4>(kOrientation).norm();  // the zero quaternion becomes NaN, which is reported as a bad initial value
}

FuselageMotion RigidBodyMount::motion(const In& x) const noexcept {
  const Eigen::Vector4d q = x.segment<4>(kOrientation) / x.segment<4>(kOrientation).norm();
  const Quaterniond orientation(q[0], q[1], q[2], q[3]);
  return {x.segment<3>(kPosition), orientation, orientation.toRotationMatrix(), x.segment<3>(kVelocity), x.segment<3>(kRates)};
}

Mount::Acceleration RigidBodyMount::acceleration(const FuselageMotion& motion, const In& u) const noexcept {
  Vector3d force_B = rotorForce(u) + externalForce(u), moment_B = rotorMoment(u) + externalMoment(u);
  if (gear_) {
    const LandingGear::Load load = gear_->load(motion);
    const Vector3d gear_force_B = motion.R_OB.transpose() * load.force_O;
    force_B += gear_force_B;
    moment_B += load.moment_B + gear_->position().cross(gear_force_B);
  }
  const Vector3d angular_momentum_B = p_.inertia * motion.rates_B;
  return {force_B / p_.mass, inverse_inertia_ * (moment_B - motion.rates_B.cross(angular_momentum_B))};
}

void RigidBodyMount::evalDerivatives(double, const In& x, const In& u, Out xdot) noexcept {
  const FuselageMotion m = motion(x);
  const Acceleration a = acceleration(m, u);
  const double s = x[kOrientation];
  const Vector3d v = x.segment<3>(kOrientation + 1);
  const double feedback = p_.norm_feedback * (1.0 - x.segment<4>(kOrientation).squaredNorm());
  xdot.segment<3>(kPosition) = m.R_OB * m.velocity_B;
  xdot[kOrientation] = -0.5 * v.dot(m.rates_B) + feedback * s;
  xdot.segment<3>(kOrientation + 1) = 0.5 * (s * m.rates_B + v.cross(m.rates_B)) + feedback * v;
  xdot.segment<3>(kVelocity) = a.specific_force_B - m.R_OB.transpose() * Vector3d(0.0, 0.0, p_.gravity) - m.rates_B.cross(m.velocity_B);
  xdot.segment<3>(kRates) = a.angular_B;
}

Mount::Momentum RigidBodyMount::momentum(const FuselageMotion& m) const noexcept {
  const Vector3d linear_O = m.R_OB * (p_.mass * m.velocity_B);
  return {linear_O, m.position_O.cross(linear_O) + m.R_OB * (p_.inertia * m.rates_B)};
}

double RigidBodyMount::energy(const FuselageMotion& m) const noexcept {
  const double kinetic = 0.5 * p_.mass * m.velocity_B.squaredNorm() + 0.5 * m.rates_B.dot(p_.inertia * m.rates_B);
  return kinetic + p_.mass * p_.gravity * m.position_O[2] + (gear_ ? gear_->energy(m) : 0.0);
}

Mount::Vector6 RigidBodyMount::springWrench(const FuselageMotion& m) const noexcept {
  Vector6 wrench = Vector6::Zero();
  if (!gear_) return wrench;
  const LandingGear::Load load = gear_->load(m);
  wrench << load.force_O, (m.position_O + m.R_OB * gear_->position()).cross(load.force_O) + m.R_OB * load.moment_B;
  return wrench;
}

}  // namespace heerk_rotor
