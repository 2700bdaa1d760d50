#pragma once
#include <optional>

#include "heerk_rotor/models/landing_gear.hpp"
#include "heerk_rotor/models/mount.hpp"

namespace heerk_rotor {

/// Mount of the modes free and spring6: the fuselage as a rigid body, without and with landing gear (landing_gear.hpp).
///   p' = R v,   q' = 1/2 q (0, omega) + k (1 - |q|^2) q,   m (v' + omega x v) = F + m R^T g,   I omega' + omega x I omega = M
/// (aeromechanics: mbs_model). k is `norm_feedback`: it takes the integrator's drift out of |q|. R is formed from q / |q|, so that
/// neither the drift nor its cure reaches the motion.
/// The springs' zero position is the origin of odom, in the orientation given by heading_deg, pitch_deg, roll_deg; with gear_preload (default)
/// the fuselage without rotor rests there, otherwise it settles under its weight.
/// States: position (odom) [m], orientation w x y z (base_link to odom), velocity [m/s] and rates [rad/s] (base_link axes).
class RigidBodyMount : public Mount {
 public:
  explicit RigidBodyMount(const MountParameters& parameters);
  std::vector<State> states() const override;
  void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept override;
  void completeInitialState(const In& u, Out x) const override;  // makes the given quaternion a unit quaternion
  std::vector<std::string> ignoredInitialValues() const override { return {"position_x_rate", "position_y_rate"}; }

 protected:
  std::vector<std::string> accelerationFeedthrough() const override { return {"rotor_force", "tilting_moment", "mast_torque", "external_wrench"}; }
  bool hasSprings() const override { return gear_.has_value(); }
  FuselageMotion motion(const In& x) const noexcept override;
  Acceleration acceleration(const FuselageMotion& motion, const In& u) const noexcept override;
  Momentum momentum(const FuselageMotion& motion) const noexcept override;
  double energy(const FuselageMotion& motion) const noexcept override;
  Vector6 springWrench(const FuselageMotion& motion) const noexcept override;

 private:
  std::optional<LandingGear> gear_;
  Eigen::Matrix3d inverse_inertia_;  // base_link [1/(kg m^2)]
};

}  // namespace heerk_rotor
