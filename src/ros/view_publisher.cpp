#include "heerk_rotor/ros/view_publisher.hpp"

#include <algorithm>
#include <functional>
#include <vector>

namespace heerk_rotor {

/// One message type with its rate.
struct ViewPublisher::Output {
  Clock::duration period;
  std::function<void(const RotorReading&, const ros::Time&)> publish;
  Clock::time_point due = {};
  ros::Time published = {};  // stamp of the last one: a stamp is never published twice
};

ViewPublisher::ViewPublisher(ros::NodeHandle& node, LatestValue<RotorPicture>& newest, const RotorGeometry& geometry, const StampBase& stamps)
    : newest_(newest), geometry_(geometry), stamps_(stamps) {
  odometry_ = node.advertise<nav_msgs::Odometry>("rotor/odom", 100);
  joints_ = node.advertise<sensor_msgs::JointState>("joint_states", 60);
  blades_ = node.advertise<visualization_msgs::MarkerArray>("rotor/blades", 5);
}

ViewPublisher::~ViewPublisher() { stop(); }

void ViewPublisher::start() {
  thread_ = std::thread([this] { run(); });
}

void ViewPublisher::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  stopping_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void ViewPublisher::run() {
  nav_msgs::Odometry odometry;
  geometry_msgs::TransformStamped transform;
  sensor_msgs::JointState joints;
  visualization_msgs::MarkerArray markers;
  RotorPicture picture;
  const auto rate = [](int hertz) { return std::chrono::duration_cast<Clock::duration>(std::chrono::seconds(1)) / hertz; };
  std::vector<Output> outputs = {
      {rate(100), [&](const RotorReading& r, const ros::Time& stamp) { toOdometry(r, stamp, odometry), odometry_.publish(odometry); }},
      {rate(60), [&](const RotorReading& r, const ros::Time& stamp) { toTransform(r, stamp, transform), broadcaster_.sendTransform(transform); }},
      {rate(60), [&](const RotorReading& r, const ros::Time& stamp) { toJointState(r, stamp, joints), joints_.publish(joints); }},
      {rate(30), [&](const RotorReading& r, const ros::Time& stamp) { toMarkers(r, picture.blades, geometry_, MarkerScale(), stamp, markers), blades_.publish(markers); }}};

  bool have = false;
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stop_) {
    have |= newest_.read(picture);
    const Clock::time_point now = Clock::now();
    const ros::Time stamp = stamps_.at(picture.instant.reading.sim_time);
    Clock::time_point next = now + std::chrono::seconds(1);
    for (Output& output : outputs) {
      if (output.due <= now) {
        if (have && stamp > output.published) {
          output.publish(picture.instant.reading, stamp);
          output.published = stamp;
        }
        output.due = std::max(output.due + output.period, now);  // what was missed is not made up for
      }
      next = std::min(next, output.due);
    }
    stopping_.wait_until(lock, next, [this] { return stop_; });
  }
}

}  // namespace heerk_rotor
