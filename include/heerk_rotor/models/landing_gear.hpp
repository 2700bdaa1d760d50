#pragma once
#include <Eigen/Geometry>

#include "heerk_rotor/models/mount_parameters.hpp"

namespace heerk_rotor {

/// Position and motion of a fuselage: odom axes O, base_link axes B, origin of B at the centre of gravity.
struct FuselageMotion {
  Eigen::Vector3d position_O;       // [m]
  Eigen::Quaterniond orientation;   // unit, turns base_link axes into odom axes
  Eigen::Matrix3d R_OB;             // the same as a matrix
  Eigen::Vector3d velocity_B;       // [m/s]
  Eigen::Vector3d rates_B;          // [rad/s]
};

/// Springs and dampers between ground and one point A of the fuselage, which resist displacement and rotation; any size of motion.
///
/// With d the displacement of A along the axes of the unloaded fuselage, and (s, v) scalar and vector part of the unit quaternion
/// from the unloaded to the present orientation (2 v is the rotation vector while it is small):
///   energy   V = 1/2 d^T K d + 1/2 (2 v)^T K_r (2 v) - F_0 . d - 2 s v . M_0
///   force    F = -dV/dd = F_0 - K d                          at A, axes of the unloaded fuselage
///   moment   M = -2 (s K_r v + (K_r v) x v) + s^2 M_0 + s M_0 x v - (M_0 . v) v    base_link axes, beside that of F
/// M is the exact gradient of V, because v' = 1/2 (s omega + v x omega) and s' = -1/2 v . omega; so springs do no work on closed
/// paths. Both are even in (s, v), which a rotation knows only up to its sign. The rotational springs are softening: their moment is that
/// of a linear spring within 4 % up to 1/2 rad, and vanishes again at half a turn.
/// Preload F_0, M_0: carries a weight at the centre of gravity, so that a fuselage of that mass rests in the zero position.
/// Dampers: force -C (velocity of A) along the axes of the unloaded fuselage; moment -C_r omega in base_link.
class LandingGear {
 public:
  explicit LandingGear(const MountParameters& parameters);

  struct Load {
    Eigen::Vector3d force_O;    // on the fuselage at A, odom axes [N]
    Eigen::Vector3d moment_B;   // on the fuselage, beside that of the force, base_link axes [N m]
  };
  Load load(const FuselageMotion& motion) const noexcept;
  double energy(const FuselageMotion& motion) const noexcept;  // V, zero in the zero position [J]
  const Eigen::Vector3d& position() const { return position_B_; }  // of A in base_link [m]

 private:
  Eigen::Vector3d displacement(const FuselageMotion& motion) const noexcept;
  Eigen::Quaterniond rotation(const FuselageMotion& motion) const noexcept;

  Eigen::Vector3d position_B_;
  Eigen::Quaterniond unloaded_;
  Eigen::Matrix3d R_OU_;                                       // axes of the unloaded fuselage U
  Eigen::Vector3d stiffness_, rotational_stiffness_, damping_, rotational_damping_;
  Eigen::Vector3d preload_force_U_, preload_moment_U_;
};

}  // namespace heerk_rotor
