#pragma once
#include <string>

#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>
#include <sensor_msgs/JointState.h>

#include "heerk_rotor/BladeAngles.h"
#include "heerk_rotor/RotorState.h"
#include "heerk_rotor/assembly/rotor_view.hpp"

namespace heerk_rotor {

/// Pure functions from a reading to ROS messages. They fill an existing message, so that a publisher that reuses it does
/// not allocate in the steady state. Units and axes are those of RotorReading; only the arrangement changes.

/// What a RotorState says beyond the reading itself.
struct PublisherNote {
  std::string command_source = "none";  // none, ros, ros_array, lcm, timeout, snapshot (simulate: file)
  std::uint64_t overruns = 0;           // steps that missed their deadline since the start
  std::uint64_t dropped = 0;            // instants this publisher's ring lost since the start
};

/// Frame names of interface.md.
namespace frames {
constexpr const char* kOdom = "odom";
constexpr const char* kBase = "base_link";
constexpr const char* kHub = "hub_link";
constexpr const char* kRotor = "rotor_link";  // turns with the hub: child of rotor_joint, whose position is the azimuth
}  // namespace frames

void toRotorState(const RotorReading& reading, const ros::Time& stamp, const PublisherNote& note, RotorState& message);

/// angle = lag, rate = lag_rate.
void toLagAngles(const RotorReading& reading, const ros::Time& stamp, BladeAngles& message);

/// Hub loads of the rotor on the fuselage, frame hub_link.
void toHubWrench(const RotorReading& reading, const ros::Time& stamp, geometry_msgs::WrenchStamped& message);

/// base_link in odom; the twist is given in base_link, as nav_msgs/Odometry asks for.
void toOdometry(const RotorReading& reading, const ros::Time& stamp, nav_msgs::Odometry& message);

/// odom -> base_link.
void toTransform(const RotorReading& reading, const ros::Time& stamp, geometry_msgs::TransformStamped& message);

/// rotor_joint (position = azimuth, unwrapped), then blade_k_flap_joint, blade_k_lag_joint, blade_k_pitch_joint for
/// k = 1..N.
void toJointState(const RotorReading& reading, const ros::Time& stamp, sensor_msgs::JointState& message);

}  // namespace heerk_rotor
