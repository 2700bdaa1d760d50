#pragma once
#include <cstdint>

#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>
#include <sensor_msgs/JointState.h>

#include "heerk_rotor/BladeAngles.h"
#include "heerk_rotor/RotorState.h"
#include "heerk_rotor/ShaftState.h"
#include "heerk_rotor/realtime/instant.hpp"

namespace heerk_rotor {

/// Pure functions from an instant or a reading to ROS messages. They fill an existing message, so that a publisher that reuses it does
/// not allocate in the steady state. Units and axes are those of the reading; only the arrangement changes.

/// What a state message says beyond the instant itself.
struct PublisherNote {
  std::uint64_t overruns = 0;  // steps that missed their deadline since the start
  std::uint64_t dropped = 0;   // instants this publisher's ring lost since the start
};

/// Frame names of interface.md.
namespace frames {
constexpr const char* kOdom = "odom";
constexpr const char* kBase = "base_link";
constexpr const char* kHub = "hub_link";
constexpr const char* kRotor = "rotor_link";  // turns with the hub: child of rotor_joint, whose position is the azimuth
constexpr const char* kShaft = "shaft_link";  // fixed in space: z along the shaft, y up
}  // namespace frames

void toRotorState(const RotorInstant& instant, const ros::Time& stamp, const PublisherNote& note, RotorState& message);

void toShaftState(const ShaftInstant& instant, const ros::Time& stamp, const PublisherNote& note, ShaftState& message);

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
