#pragma once
#include <Eigen/Geometry>

#include "heerk_rotor/config/section.hpp"

namespace heerk_rotor {

enum class MountMode { kRigid, kSpring2, kSpring6, kFree };

/// Parameters of the mount (mount.hpp). Defaults: mass of a BO105 in flight (NASA CR-3144); its inertia and hub position are
/// rounded values of that class; everything about springs and dampers is ASSUMED. The default landing gear is stiff enough that all modes of the
/// fuselage lie above 23 rad/s with 200 kg of rotor, clear of the regressing lag mode of such a rotor (15 rad/s): no ground resonance.
///
/// Keys are the names of the members, except
///   mode (rigid | spring2 | spring6 | free); rotation (ccw | cw)
///   shaft_tilt_forward_deg, heading_deg, pitch_deg, roll_deg: turned in this order about z, the new y, the new x (ROS: pitch nose down positive)
///   inertia: [Ixx, Iyy, Izz], products_of_inertia: [Ixy, Ixz, Iyz] = integrals of x y dm, ...; off the diagonal the tensor has -Ixy, ...
///   gear_preload (true | false): whether the springs carry gear_preload_mass (default: mass) in their zero position
///   mass_x, mass_y, stiffness or frequency [rad/s], damping: of spring2, one number for both axes or [x, y]
struct MountParameters {
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  MountMode mode = MountMode::kFree;
  bool clockwise = false;                              // sense of rotation of the rotor, seen from above

  // Geometry, in base_link (x forward, y left, z up), origin at the centre of gravity of the fuselage
  Eigen::Vector3d hub_offset{0.0, 0.0, 1.5};           // hub centre [m]
  double shaft_tilt_forward = 0.0;                     // rotation of hub_link about +y of base_link [rad]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // of base_link in odom: fixed, unloaded or initial, by mode

  // Surroundings
  double gravity = 9.80665;                            // standard gravity; 0: no weight anywhere [m/s^2]
  Eigen::Vector3d wind = Eigen::Vector3d::Zero();      // until a command arrives, in odom [m/s]

  // Rigid body (free, spring6)
  double mass = 2096.0;                                // without blades [kg]
  Eigen::Matrix3d inertia = Eigen::Vector3d(1433.0, 4973.0, 4099.0).asDiagonal();  // about the centre of gravity, base_link [kg m^2]
  double norm_feedback = 1.0;                          // by which the quaternion returns to unit length [1/s]

  // Landing gear (spring6), along the axes of the unloaded fuselage; x y z, then rotation about x y z
  Vector6 gear_stiffness{(Vector6() << 2.5e6, 2.5e6, 2e6, 6e6, 8e6, 3e6).finished()};  // [N/m], [N m/rad]
  Vector6 gear_damping{(Vector6() << 2e4, 2e4, 1.3e4, 3e4, 5e4, 2.2e4).finished()};    // near 10 % of critical [N s/m], [N m s/rad]
  Eigen::Vector3d gear_position{0.0, 0.0, -1.2};       // where the springs are attached, in base_link [m]
  double gear_preload_mass = 2096.0;                   // whose weight the springs carry in their zero position [kg]

  // Support in the plane (spring2), along x and y of odom
  Eigen::Vector2d planar_mass{2096.0, 2096.0};         // effective [kg]
  Eigen::Vector2d planar_stiffness{2096.0 * 355.3, 2096.0 * 355.3};  // 3 Hz [N/m]
  Eigen::Vector2d planar_damping{0.0, 0.0};            // [N s/m]
};

/// Reads the keys of all modes, whichever is chosen, so that one word swaps the modes; finishes the section.
MountParameters readMountParameters(Section& section);

}  // namespace heerk_rotor
