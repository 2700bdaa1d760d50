#include "heerk_rotor/ros/rotor_markers.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "heerk_rotor/ros/conversions.hpp"

namespace heerk_rotor {
namespace {

constexpr double kTwoPi = 6.283185307179586476925;

void assign(const Eigen::Vector3d& vector, geometry_msgs::Point& target) {
  target.x = vector.x();
  target.y = vector.y();
  target.z = vector.z();
}

void assign(const Eigen::Quaterniond& rotation, geometry_msgs::Quaternion& target) {
  target.w = rotation.w();
  target.x = rotation.x();
  target.y = rotation.y();
  target.z = rotation.z();
}

/// Grey for 0, red for +1, blue for -1.
void assignColour(double value, std_msgs::ColorRGBA& colour) {
  const double v = std::clamp(value, -1.0, 1.0), grey = 0.75 * (1.0 - std::abs(v));
  colour.r = static_cast<float>(grey + std::max(v, 0.0) * 0.85);
  colour.g = static_cast<float>(grey + std::abs(v) * 0.15);
  colour.b = static_cast<float>(grey + std::max(-v, 0.0) * 0.9);
  colour.a = 1.0f;
}

}  // namespace

void toMarkers(const RotorReading& reading, const RotorGeometry& geometry, const MarkerScale& scale, const ros::Time& stamp,
               visualization_msgs::MarkerArray& message) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  message.markers.resize(static_cast<std::size_t>(reading.blades) + 1);
  for (visualization_msgs::Marker& marker : message.markers) {
    marker.header.stamp = stamp;
    marker.header.frame_id = frames::kRotor;
    marker.action = visualization_msgs::Marker::ADD;
    marker.frame_locked = true;  // drawn with the newest transform: no flicker when tf arrives later
  }

  const double length = geometry.radius - geometry.root_cutout;
  const Vector3d hinge(geometry.hinge_offset, 0.0, 0.0), middle(0.5 * (geometry.root_cutout + geometry.radius) - geometry.hinge_offset, 0.0, 0.0);
  for (int k = 0; k < reading.blades; ++k) {
    visualization_msgs::Marker& blade = message.markers[static_cast<std::size_t>(k)];
    // The azimuth is in tf: an angle of its own would differ from the robot model's by what turns between two messages.
    // Flap is about -y (up positive), lag about +z (lead positive), pitch about x.
    const Eigen::Quaterniond azimuth(AngleAxisd(kTwoPi * k / reading.blades, Vector3d::UnitZ()));
    const Eigen::Quaterniond hinged = AngleAxisd(-reading.flap[k], Vector3d::UnitY()) * Eigen::Quaterniond(AngleAxisd(reading.lag[k], Vector3d::UnitZ()));
    const Eigen::Quaterniond pitched(AngleAxisd(reading.pitch[k], Vector3d::UnitX()));
    assign(Vector3d(azimuth * (hinge + hinged * middle)), blade.pose.position);
    assign(azimuth * hinged * pitched, blade.pose.orientation);
    blade.ns = "blades";
    blade.id = k;
    blade.type = visualization_msgs::Marker::CUBE;
    blade.scale.x = length;
    blade.scale.y = geometry.chord;
    blade.scale.z = 0.15 * geometry.chord;
    assignColour((reading.lag[k] - reading.lag_collective) / scale.lag_range, blade.color);
  }

  visualization_msgs::Marker& arrow = message.markers.back();
  arrow.ns = "hub_force";
  arrow.header.frame_id = frames::kHub;
  arrow.type = visualization_msgs::Marker::ARROW;
  arrow.pose.orientation.w = 1.0;
  arrow.points.resize(2);
  assign(Vector3d::Zero(), arrow.points[0]);
  assign(Vector3d(scale.force_length * Vector3d(reading.hub_force[0], reading.hub_force[1], reading.hub_force[2])), arrow.points[1]);
  arrow.scale.x = 0.06;  // shaft diameter, head diameter, head length [m]
  arrow.scale.y = 0.15;
  arrow.scale.z = 0.25;
  arrow.color.r = 1.0f;
  arrow.color.g = 0.75f;
  arrow.color.b = 0.1f;
  arrow.color.a = 1.0f;
}

}  // namespace heerk_rotor
