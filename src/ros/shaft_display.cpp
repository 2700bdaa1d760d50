#include <algorithm>
#include <cmath>
#include <memory>

#include <tf2_ros/static_transform_broadcaster.h>

#include "heerk_rotor/config/simulation_settings.hpp"
#include "heerk_rotor/ros/conversions.hpp"
#include "heerk_rotor/ros/display.hpp"
#include "heerk_rotor/ros/shaft_markers.hpp"

namespace heerk_rotor {
namespace {

/// shaft/orbit. What has passed between two pictures comes through a ring of its own, some points per turn.
class OrbitDisplay {
 public:
  OrbitDisplay(ShaftFeed& feed, ros::NodeHandle& node, const Configuration& configuration)
      : geometry_(readShaftGeometry(configuration)), publisher_(node.advertise<visualization_msgs::MarkerArray>("shaft/orbit", 5)) {
    Problems ignored;  // the simulation has been built from this configuration
    const SimulationSettings settings = readSimulationSettings(configuration, ignored);
    feed.addRing(ring_, static_cast<std::uint64_t>(std::max(1.0, std::round(settings.revolution() / settings.step / OrbitTrail::kPointsPerTurn))));
    broadcaster_.sendTransform(standing());
  }

  void publish(const ShaftPicture& picture, const ros::Time& stamp) {
    for (ShaftInstant instant; ring_.pop(instant);) trail_.add(instant.reading);
    toMarkers(picture.instant.reading, picture.shape, trail_, geometry_, stamp, message_);
    publisher_.publish(message_);
  }

 private:
  /// odom -> shaft_link: the shaft lies along x of odom, its y is up.
  static geometry_msgs::TransformStamped standing() {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = ros::Time::now();
    transform.header.frame_id = frames::kOdom;
    transform.child_frame_id = frames::kShaft;
    transform.transform.rotation.x = transform.transform.rotation.y = transform.transform.rotation.z = transform.transform.rotation.w = 0.5;
    return transform;
  }

  const ShaftGeometry geometry_;
  ShaftRing ring_{4096};  // a third of a second at 100 turns per second
  OrbitTrail trail_;
  ros::Publisher publisher_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  visualization_msgs::MarkerArray message_;
};

}  // namespace

std::vector<ViewOutput<ShaftPicture>> display(ShaftFeed& feed, ros::NodeHandle& node, const Configuration& configuration) {
  const auto orbits = std::make_shared<OrbitDisplay>(feed, node, configuration);
  return {{30, [orbits](const ShaftPicture& picture, const ros::Time& stamp) { orbits->publish(picture, stamp); }}};
}

}  // namespace heerk_rotor
