#pragma once
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "heerk_rotor/realtime/instant.hpp"
#include "heerk_rotor/ros/conversions.hpp"

namespace heerk_rotor {

/// The topics that tell of every published instant. Messages are reused, so that publishing does not allocate them anew.
template <class Instant>
class StateTopics;

/// rotor/state, rotor/lag_angles and rotor/hub_wrench.
template <>
class StateTopics<RotorInstant> {
 public:
  explicit StateTopics(ros::NodeHandle& node);
  void publish(const RotorInstant& instant, const ros::Time& stamp, const PublisherNote& note);

 private:
  ros::Publisher state_, lag_, wrench_;
  RotorState state_message_;
  BladeAngles lag_message_;
  geometry_msgs::WrenchStamped wrench_message_;
};

/// shaft/state.
template <>
class StateTopics<ShaftInstant> {
 public:
  explicit StateTopics(ros::NodeHandle& node);
  void publish(const ShaftInstant& instant, const ros::Time& stamp, const PublisherNote& note);

 private:
  ros::Publisher state_;
  ShaftState state_message_;
};

}  // namespace heerk_rotor
