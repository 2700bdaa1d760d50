#include "heerk_rotor/ros/disturbance_inputs.hpp"

#include <string>

#include <geometry_msgs/Vector3Stamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <std_msgs/Float64.h>

#include "heerk_rotor/ros/conversions.hpp"

namespace heerk_rotor {
namespace {

/// tf names used to begin with a slash.
bool isFrame(const std::string& frame, const std::string& expected) { return frame.empty() || frame == expected || frame == "/" + expected; }

template <class Message>
bool hasFrame(const Message& message, const std::string& expected, HeldInput& input) {
  if (isFrame(message.header.frame_id, expected)) return true;
  input.refuse("frame '" + message.header.frame_id + "', expected '" + expected + "'");
  return false;
}

}  // namespace

DisturbanceInputs::DisturbanceInputs(const CoupledSystem& system, const CommandView& commands)
    : speed_(system, "speed command", commands.speed(), {"rad/s"}),
      wind_(system, "wind", commands.wind(), {"m/s"}),
      external_wrench_(system, "external wrench", commands.externalWrench(), {"N", "N", "N", "N m"}) {}

void DisturbanceInputs::subscribe(ros::NodeHandle& node) {
  // Only the newest message matters. roscpp calls one subscriber's callbacks one after the other: one writer per input.
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  const auto onSpeed = [this](const std_msgs::Float64::ConstPtr& speed) { speed_.accept({speed->data}); };
  const auto onWind = [this](const geometry_msgs::Vector3Stamped::ConstPtr& wind) {
    if (hasFrame(*wind, frames::kOdom, wind_)) wind_.accept({wind->vector.x, wind->vector.y, wind->vector.z});
  };
  const auto onWrench = [this](const geometry_msgs::WrenchStamped::ConstPtr& message) {
    const geometry_msgs::Wrench& w = message->wrench;
    if (hasFrame(*message, frames::kBase, external_wrench_)) external_wrench_.accept({w.force.x, w.force.y, w.force.z, w.torque.x, w.torque.y, w.torque.z});
  };
  subscribers_.push_back(node.subscribe<std_msgs::Float64>("rotor/speed_command", 1, onSpeed, ros::VoidConstPtr(), hints));
  subscribers_.push_back(node.subscribe<geometry_msgs::Vector3Stamped>("rotor/wind", 1, onWind, ros::VoidConstPtr(), hints));
  subscribers_.push_back(node.subscribe<geometry_msgs::WrenchStamped>("rotor/external_wrench", 1, onWrench, ros::VoidConstPtr(), hints));
}

}  // namespace heerk_rotor
