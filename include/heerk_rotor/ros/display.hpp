#pragma once
#include <vector>

#include <ros/node_handle.h>

#include "heerk_rotor/config/configuration.hpp"
#include "heerk_rotor/realtime/instant_feed.hpp"
#include "heerk_rotor/ros/view_publisher.hpp"

namespace heerk_rotor {

/// rotor/odom 100 Hz, tf odom -> base_link and joint_states 60 Hz, rotor/blades 30 Hz.
std::vector<ViewOutput<RotorPicture>> display(RotorFeed& feed, ros::NodeHandle& node, const Configuration& configuration);

/// shaft/orbit 30 Hz; tf odom -> shaft_link once and for all. Takes a ring of the feed for the orbits.
std::vector<ViewOutput<ShaftPicture>> display(ShaftFeed& feed, ros::NodeHandle& node, const Configuration& configuration);

}  // namespace heerk_rotor
