#include <nav_msgs/Odometry.h>
#include <sensor_msgs/JointState.h>
#include <tf2_ros/transform_broadcaster.h>

#include "heerk_rotor/ros/conversions.hpp"
#include "heerk_rotor/ros/display.hpp"
#include "heerk_rotor/ros/rotor_geometry.hpp"
#include "heerk_rotor/ros/rotor_markers.hpp"

namespace heerk_rotor {

std::vector<ViewOutput<RotorPicture>> display(RotorFeed&, ros::NodeHandle& node, const Configuration& configuration) {
  // Each output keeps its message, so that publishing does not allocate it anew.
  const auto odometry = [publisher = node.advertise<nav_msgs::Odometry>("rotor/odom", 100), message = nav_msgs::Odometry()](const RotorPicture& p, const ros::Time& stamp) mutable {
    toOdometry(p.instant.reading, stamp, message);
    publisher.publish(message);
  };
  const auto transform = [broadcaster = tf2_ros::TransformBroadcaster(), message = geometry_msgs::TransformStamped()](const RotorPicture& p, const ros::Time& stamp) mutable {
    toTransform(p.instant.reading, stamp, message);
    broadcaster.sendTransform(message);
  };
  const auto joints = [publisher = node.advertise<sensor_msgs::JointState>("joint_states", 60), message = sensor_msgs::JointState()](const RotorPicture& p, const ros::Time& stamp) mutable {
    toJointState(p.instant.reading, stamp, message);
    publisher.publish(message);
  };
  const auto blades = [publisher = node.advertise<visualization_msgs::MarkerArray>("rotor/blades", 5), message = visualization_msgs::MarkerArray(),
                       geometry = readRotorGeometry(configuration)](const RotorPicture& p, const ros::Time& stamp) mutable {
    toMarkers(p.instant.reading, p.shape, geometry, MarkerScale(), stamp, message);
    publisher.publish(message);
  };
  return {{100, odometry}, {60, transform}, {60, joints}, {30, blades}};
}

}  // namespace heerk_rotor
