#pragma once
#include <Eigen/Geometry>

#include "heerk_rotor/config/section.hpp"

namespace heerk_rotor {

enum class MountMode { kRigid, kSpring2, kSpring6, kFree };

/// Parameters of the mount (mount.hpp). Defaults: mass of a BO105 in flight (NASA CR-3144); its inertia and hub position are
/// rounded values of that class; everything about springs and dampers is ASSUMED.
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
  Vector6 gear_stiffness{(Vector6() << 6e5, 6e5, 1e6, 1.5e6, 6.5e5, 9e5).finished()};  // [N/m], [N m/rad]
  Vector6 gear_damping{(Vector6() << 7e3, 7e3, 9e3, 9e3, 1.1e4, 1.2e4).finished()};    // near 10 % of critical [N s/m], [N m s/rad]
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
