#include "heerk_rotor/models/planar_mount.hpp"

namespace heerk_rotor {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {
enum State_ { kPosition, kRate = 2 };
}

PlanarMount::PlanarMount(const MountParameters& parameters) : Mount(parameters), R_OB_(parameters.orientation.toRotationMatrix()) {
  const Vector3d inverse_mass_O(1.0 / p_.planar_mass[0], 1.0 / p_.planar_mass[1], 0.0);  // the guide takes the force along z
  setLoadGain(R_OB_.transpose() * inverse_mass_O.asDiagonal() * R_OB_, Eigen::Matrix3d::Zero());
}

std::vector<State> PlanarMount::states() const {
  return {{"position_x", "m", "displacement along x of odom"}, {"position_y", "m", "displacement along y of odom"},
          {"position_x_rate", "m/s", "velocity along x of odom"}, {"position_y_rate", "m/s", "velocity along y of odom"}};
}

std::vector<std::string> PlanarMount::ignoredInitialValues() const {
  return {"position_z", "orientation_w", "orientation_x", "orientation_y", "orientation_z", "velocity_x", "velocity_y", "velocity_z", "rate_x", "rate_y", "rate_z"};
}

FuselageMotion PlanarMount::motion(const In& x) const noexcept {
  return {{x[kPosition], x[kPosition + 1], 0.0}, p_.orientation, R_OB_, R_OB_.transpose() * Vector3d(x[kRate], x[kRate + 1], 0.0), Vector3d::Zero()};
}

Vector2d PlanarMount::planarAcceleration(const FuselageMotion& motion, const In& u) const noexcept {
  const Vector3d force_O = R_OB_ * (rotorForce(u) + externalForce(u));
  return (force_O.head<2>() + springWrench(motion).head<2>()).cwiseQuotient(p_.planar_mass);
}

Mount::Acceleration PlanarMount::acceleration(const FuselageMotion& motion, const In& u) const noexcept {
  const Vector2d a = planarAcceleration(motion, u);
  return {R_OB_.transpose() * Vector3d(a[0], a[1], p_.gravity), Vector3d::Zero()};
}

void PlanarMount::evalDerivatives(double, const In& x, const In& u, Out xdot) noexcept {
  xdot.head<2>() = x.segment<2>(kRate);
  xdot.tail<2>() = planarAcceleration(motion(x), u);
}

Mount::Momentum PlanarMount::momentum(const FuselageMotion& motion) const noexcept {
  const Vector3d velocity_O = R_OB_ * motion.velocity_B;
  const Vector3d momentum_O(p_.planar_mass[0] * velocity_O[0], p_.planar_mass[1] * velocity_O[1], 0.0);
  return {momentum_O, motion.position_O.cross(momentum_O)};
}

double PlanarMount::energy(const FuselageMotion& motion) const noexcept {
  const Vector2d position = motion.position_O.head<2>(), velocity = (R_OB_ * motion.velocity_B).head<2>();
  return 0.5 * p_.planar_mass.dot(velocity.cwiseAbs2()) + 0.5 * p_.planar_stiffness.dot(position.cwiseAbs2());  // no weight: the height is fixed
}

Mount::Vector6 PlanarMount::springWrench(const FuselageMotion& motion) const noexcept {
  const Vector3d velocity_O = R_OB_ * motion.velocity_B;
  Vector3d force_O = Vector3d::Zero();
  force_O.head<2>() = -p_.planar_stiffness.cwiseProduct(motion.position_O.head<2>()) - p_.planar_damping.cwiseProduct(velocity_O.head<2>());
  Vector6 wrench;
  wrench << force_O, motion.position_O.cross(force_O);
  return wrench;
}

}  // namespace heerk_rotor
