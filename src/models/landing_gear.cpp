#include "heerk_rotor/models/landing_gear.hpp"

namespace heerk_rotor {

using Eigen::Vector3d;

LandingGear::LandingGear(const MountParameters& p)
    : position_B_(p.gear_position), unloaded_(p.orientation), R_OU_(p.orientation.toRotationMatrix()),
      stiffness_(p.gear_stiffness.head<3>()), rotational_stiffness_(p.gear_stiffness.tail<3>()),
      damping_(p.gear_damping.head<3>()), rotational_damping_(p.gear_damping.tail<3>()) {
  preload_force_U_ = R_OU_.transpose() * Vector3d(0.0, 0.0, p.gear_preload_mass * p.gravity);
  preload_moment_U_ = -position_B_.cross(preload_force_U_);  // the weight acts at the centre of gravity, the springs at A
}

Vector3d LandingGear::displacement(const FuselageMotion& motion) const noexcept {
  return R_OU_.transpose() * (motion.position_O + motion.R_OB * position_B_) - position_B_;
}

Eigen::Quaterniond LandingGear::rotation(const FuselageMotion& motion) const noexcept { return unloaded_.conjugate() * motion.orientation; }

LandingGear::Load LandingGear::load(const FuselageMotion& motion) const noexcept {
  const Vector3d velocity_O = motion.R_OB * (motion.velocity_B + motion.rates_B.cross(position_B_));
  const Vector3d velocity_U = R_OU_.transpose() * velocity_O;
  const Eigen::Quaterniond q = rotation(motion);
  const Vector3d v = q.vec(), elastic = rotational_stiffness_.cwiseProduct(v);
  const double s = q.w();

  Load load;
  load.force_O = R_OU_ * (preload_force_U_ - stiffness_.cwiseProduct(displacement(motion)) - damping_.cwiseProduct(velocity_U));
  load.moment_B = -2.0 * (s * elastic + elastic.cross(v)) - rotational_damping_.cwiseProduct(motion.rates_B);
  load.moment_B += s * s * preload_moment_U_ + s * preload_moment_U_.cross(v) - preload_moment_U_.dot(v) * v;
  return load;
}

double LandingGear::energy(const FuselageMotion& motion) const noexcept {
  const Eigen::Quaterniond q = rotation(motion);
  const Vector3d d = displacement(motion), v = q.vec();
  return 0.5 * d.dot(stiffness_.cwiseProduct(d)) + 2.0 * v.dot(rotational_stiffness_.cwiseProduct(v)) - preload_force_U_.dot(d) -
         2.0 * q.w() * v.dot(preload_moment_U_);
}

}  // namespace heerk_rotor
