#include "heerk_rotor/ros/rotor_markers.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "heerk_rotor/ros/blade_mesh.hpp"
#include "heerk_rotor/ros/conversions.hpp"

namespace heerk_rotor {
namespace {

using Eigen::Vector3d;

constexpr double kTwoPi = 6.283185307179586476925;
constexpr double kSeaLevelDensity = 1.225;  // [kg/m^3], standard atmosphere

void assign(const Vector3d& vector, geometry_msgs::Point& target) {
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

/// A rigid blade as a plate.
void drawPlate(const RotorReading& reading, int k, const RotorGeometry& geometry, const MarkerScale& scale, visualization_msgs::Marker& blade) {
  using Eigen::AngleAxisd;
  const Vector3d hinge(geometry.hinge_offset, 0.0, 0.0), middle(0.5 * (geometry.root_cutout + geometry.radius) - geometry.hinge_offset, 0.0, 0.0);
  // The azimuth is in tf: an angle of its own would differ from the robot model's by what turns between two messages. Flap is about -y
  // (up positive), lag about +z (lead positive), pitch about x; on a clockwise rotor the last two and the blades' order are reversed.
  const double sense = geometry.clockwise ? -1.0 : 1.0;
  const Eigen::Quaterniond azimuth(AngleAxisd(sense * kTwoPi * k / reading.blades, Vector3d::UnitZ()));
  const Eigen::Quaterniond hinged = AngleAxisd(-reading.flap[k], Vector3d::UnitY()) * Eigen::Quaterniond(AngleAxisd(sense * reading.lag[k], Vector3d::UnitZ()));
  const Eigen::Quaterniond pitched(AngleAxisd(sense * reading.pitch[k], Vector3d::UnitX()));
  assign(Vector3d(azimuth * (hinge + hinged * middle)), blade.pose.position);
  assign(azimuth * hinged * pitched, blade.pose.orientation);
  blade.type = visualization_msgs::Marker::CUBE;
  blade.scale.x = geometry.radius - geometry.root_cutout;
  blade.scale.y = geometry.chord;
  blade.scale.z = 0.15 * geometry.chord;
  assignColour((reading.lag[k] - reading.lag_collective) / scale.lag_range, blade.color);
}

void drawElasticBlade(const RotorReading& reading, const BladeShapes& shapes, int k, const RotorGeometry& geometry, const MarkerScale& scale,
                      visualization_msgs::Marker& blade) {
  const double speed = 0.8 * geometry.radius * reading.rotor_speed;
  const double full_load = std::max(0.5 * kSeaLevelDensity * speed * speed * geometry.chord * scale.lift_coefficient, 1.0);  // [N/m]
  blade.type = visualization_msgs::Marker::TRIANGLE_LIST;
  blade.pose.orientation.w = 1.0;
  blade.scale.x = blade.scale.y = blade.scale.z = 1.0;
  blade.color.a = 1.0f;
  toBladeMesh(shapes, k, geometry, full_load, blade);
}

/// The circle through the tips, tilted and coned by the multiblade coordinates of flap.
void drawTipPath(const RotorReading& reading, const RotorGeometry& geometry, visualization_msgs::Marker& ring) {
  constexpr int kPoints = 72;
  ring.type = visualization_msgs::Marker::LINE_STRIP;
  ring.pose.orientation.w = 1.0;
  ring.points.resize(kPoints + 1);
  const double arm = geometry.radius - geometry.hinge_offset, sense = geometry.clockwise ? -1.0 : 1.0;
  for (int i = 0; i <= kPoints; ++i) {
    const double psi = kTwoPi * i / kPoints, cosine = std::cos(psi), sine = std::sin(psi);
    const double flap = reading.flap_collective + reading.flap_cosine * cosine + reading.flap_sine * sine;
    assign(Vector3d(-geometry.radius * cosine, -sense * geometry.radius * sine, arm * flap), ring.points[static_cast<std::size_t>(i)]);
  }
  ring.scale.x = 0.02;  // width [m]
  ring.color.r = ring.color.g = ring.color.b = 0.8f;
  ring.color.a = 0.35f;
}

void drawHubForce(const RotorReading& reading, const MarkerScale& scale, visualization_msgs::Marker& arrow) {
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

}  // namespace

void toMarkers(const RotorReading& reading, const BladeShapes& shapes, const RotorGeometry& geometry, const MarkerScale& scale, const ros::Time& stamp,
               visualization_msgs::MarkerArray& message) {
  const std::size_t blades = static_cast<std::size_t>(reading.blades);
  message.markers.resize(blades + 2);
  const bool elastic = shapes.blades == reading.blades && shapes.sections > 0 && !geometry.sections.empty();
  for (std::size_t i = 0; i < message.markers.size(); ++i) {
    visualization_msgs::Marker& marker = message.markers[i];
    marker.header.stamp = stamp;
    marker.header.frame_id = i < blades ? frames::kRotor : frames::kHub;
    marker.ns = i < blades ? "blades" : i == blades ? "tip_path" : "hub_force";
    marker.id = i < blades ? static_cast<int>(i) : 0;
    marker.action = visualization_msgs::Marker::ADD;
    marker.frame_locked = true;  // drawn with the newest transform: no flicker when tf arrives later
  }
  for (int k = 0; k < reading.blades; ++k) {
    visualization_msgs::Marker& blade = message.markers[static_cast<std::size_t>(k)];
    if (elastic) drawElasticBlade(reading, shapes, k, geometry, scale, blade);
    else drawPlate(reading, k, geometry, scale, blade);
  }
  drawTipPath(reading, geometry, message.markers[blades]);
  drawHubForce(reading, scale, message.markers[blades + 1]);
}

}  // namespace heerk_rotor
