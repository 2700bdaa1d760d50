#pragma once
#include "heerk_rotor/models/mount.hpp"

namespace heerk_rotor {

/// Mount of mode spring2: a fuselage that moves along x and y of odom on springs and dampers; height and orientation are fixed.
///   m_x x'' + c_x x' + k_x x = F_x,   m_y y'' + c_y y' + k_y y = F_y
/// F: rotor_force and external force turned into odom. Moments, and the force along z, go to the guide. This is the support of the ground
/// resonance analyses (HEERK paper, Section 3), where m is an effective mass.
/// States: position_x, position_y [m] and their rates [m/s], odom axes.
class PlanarMount : public Mount {
 public:
  explicit PlanarMount(const MountParameters& parameters);
  std::vector<State> states() const override;
  void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept override;
  std::vector<std::string> ignoredInitialValues() const override;

 protected:
  std::vector<std::string> accelerationFeedthrough() const override { return {"rotor_force", "external_wrench"}; }
  bool hasSprings() const override { return true; }
  FuselageMotion motion(const In& x) const noexcept override;
  Acceleration acceleration(const FuselageMotion& motion, const In& u) const noexcept override;
  Momentum momentum(const FuselageMotion& motion) const noexcept override;
  double energy(const FuselageMotion& motion) const noexcept override;
  Vector6 springWrench(const FuselageMotion& motion) const noexcept override;

 private:
  Eigen::Vector2d planarAcceleration(const FuselageMotion& motion, const In& u) const noexcept;

  Eigen::Matrix3d R_OB_;
};

}  // namespace heerk_rotor
