#pragma once
#include "heerk_rotor/core/subsystem_model.hpp"
#include "heerk_rotor/models/landing_gear.hpp"
#include "heerk_rotor/models/mount_parameters.hpp"

namespace heerk_rotor {

/// What carries the rotor hub: the part that all modes share. Modes, chosen by one word:
///   rigid    wind-tunnel mount, nothing moves                                    (RigidMount)
///   spring2  fuselage moves along x and y of odom on springs, does not rotate    (PlanarMount)
///   spring6  rigid body on landing-gear springs                                  (RigidBodyMount)
///   free     rigid body in flight                                                (RigidBodyMount)
///
/// Frames: odom (O, inertial, z up), base_link (B: x forward, y left, z up; origin: centre of gravity of the fuselage without rotor),
/// hub_link (H: turned from B by the shaft tilt about +y, forward positive; origin: hub centre at r = hub_offset in B).
///   hub velocity      v + omega x r
///   hub acceleration  a + omega' x r + omega x (omega x r), a = v' + omega x v; published minus gravity, that is as
///                     specific force: a support at rest shows +9.80665 m/s^2 upward, a body in free fall shows zero
///   loads on B        F = R_BH rotor_force + ...,  M = R_BH (tilting_moment, mast_torque) + r x R_BH rotor_force + ...
///
/// A clockwise rotor (rotation: cw) is calculated as its mirror image at the x-z plane: all models of the rotor side turn
/// counter-clockwise always, in axes H' whose y is H's -y. The mount is the only place where both meet. Towards the rotor
/// (mount_velocity, mount_acceleration, hub_wind; rotor_force, tilting_moment, mast_torque) everything is in H': of vectors y
/// changes sign, of rates and moments x and z do. All other ports are in true ROS axes.
///
/// Inputs: rotor_force [N], tilting_moment (about x, y) [N m], mast_torque (about +z) [N m], in H'; external_wrench (command: force at
/// and moment about the centre of gravity, base_link axes); wind (command: over ground, odom axes) [m/s].
/// Outputs: mount_velocity, mount_acceleration, hub_wind, hub_gravity in H'; fuselage_position, _orientation (w x y z), _velocity, _rates
/// (the last two in base_link axes); hub_force, hub_moment: what the fuselage receives at the hub, in H. For balances:
/// hub_position, hub_orientation, fuselage_momentum, fuselage_angular_momentum (about the origin of odom), fuselage_energy
/// (kinetic, springs, gravity), spring_wrench (sprung modes: force, and moment about the origin of odom, odom axes).
/// Feedthrough: the loads reach mount_acceleration, and do so linearly with constant coefficients (load_gain_): the algebraic
/// loop of the blades' inertia closes here, and gets an exact gradient.
class Mount : public SubsystemModel {
 public:
  explicit Mount(const MountParameters& parameters);

  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  bool outputJacobian(Index port, double t, const In& x, const In& u, Eigen::Map<Matrix> jacobian) noexcept override;
  /// All initial values of all modes are accepted by each.
  std::vector<std::string> ignoredInitialValues() const override;

 protected:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  static constexpr Index kLoads = 12;  // leading entries of u: rotor_force, tilting_moment, mast_torque, external_wrench

  struct Acceleration {
    Eigen::Vector3d specific_force_B;  // of the centre of gravity, minus gravity [m/s^2]
    Eigen::Vector3d angular_B;         // [rad/s^2]
  };
  struct Momentum {
    Eigen::Vector3d linear_O;          // [N s]
    Eigen::Vector3d angular_O;         // about the origin of odom [N m s]
  };

  // What distinguishes the modes.
  virtual std::vector<std::string> accelerationFeedthrough() const = 0;
  virtual bool hasSprings() const = 0;
  virtual FuselageMotion motion(const In& x) const noexcept = 0;
  virtual Acceleration acceleration(const FuselageMotion& motion, const In& u) const noexcept = 0;
  virtual Momentum momentum(const FuselageMotion& motion) const noexcept = 0;
  virtual double energy(const FuselageMotion& motion) const noexcept = 0;
  virtual Vector6 springWrench(const FuselageMotion& motion) const noexcept = 0;

  Eigen::Vector3d rotorForce(const In& u) const noexcept;      // base_link axes
  Eigen::Vector3d rotorMoment(const In& u) const noexcept;     // about the centre of gravity, base_link axes
  static Eigen::Vector3d externalForce(const In& u) noexcept;  // base_link axes
  static Eigen::Vector3d externalMoment(const In& u) noexcept;
  /// Gain of mount_acceleration for a body of this inverse mass and inverse inertia.
  void setLoadGain(const Eigen::Matrix3d& inverse_mass_B, const Eigen::Matrix3d& inverse_inertia_B);

  MountParameters p_;
  Eigen::Matrix3d R_BH_;

 private:
  Eigen::Vector3d polar_, axial_;                 // signs that take components from H to H', and back
  Eigen::Matrix<double, 6, kLoads> load_gain_;    // d mount_acceleration / d loads
};

/// Turns the components of a polar vector (force, velocity) or of an axial vector (moment, rate) to the mirror image at the x-z plane.
Eigen::Vector3d mirroredPolar(const Eigen::Vector3d& vector) noexcept;
Eigen::Vector3d mirroredAxial(const Eigen::Vector3d& vector) noexcept;

/// A mount in a wind tunnel: at the origin of odom, oriented once and for all.
class RigidMount : public Mount {
 public:
  explicit RigidMount(const MountParameters& parameters) : Mount(parameters) {}
  std::vector<State> states() const override { return {}; }
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}

 protected:
  std::vector<std::string> accelerationFeedthrough() const override { return {}; }
  bool hasSprings() const override { return false; }
  FuselageMotion motion(const In& x) const noexcept override;
  Acceleration acceleration(const FuselageMotion& motion, const In& u) const noexcept override;
  Momentum momentum(const FuselageMotion&) const noexcept override { return {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}; }
  double energy(const FuselageMotion&) const noexcept override { return 0.0; }
  Vector6 springWrench(const FuselageMotion&) const noexcept override { return Vector6::Zero(); }
};

}  // namespace heerk_rotor
