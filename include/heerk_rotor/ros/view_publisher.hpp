#pragma once
#include <condition_variable>
#include <mutex>
#include <thread>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <tf2_ros/transform_broadcaster.h>

#include "heerk_rotor/realtime/latest_value.hpp"
#include "heerk_rotor/realtime/rotor_instant.hpp"
#include "heerk_rotor/ros/conversions.hpp"
#include "heerk_rotor/ros/rotor_geometry.hpp"
#include "heerk_rotor/ros/rotor_markers.hpp"
#include "heerk_rotor/ros/stamp_base.hpp"

namespace heerk_rotor {

/// Publishes the newest instant at rates fit for eyes and navigation, per second of real time: rotor/odom 100 Hz,
/// tf odom -> base_link and joint_states 60 Hz, rotor/blades 30 Hz. While the simulation stands still it is silent.
class ViewPublisher {
 public:
  /// `newest` must outlive the publisher, which is its only reader.
  ViewPublisher(ros::NodeHandle& node, LatestValue<RotorPicture>& newest, const RotorGeometry& geometry, const StampBase& stamps);
  ~ViewPublisher();

  void start();
  void stop();

 private:
  using Clock = std::chrono::steady_clock;
  struct Output;
  void run();

  LatestValue<RotorPicture>& newest_;
  const RotorGeometry geometry_;
  const StampBase stamps_;
  ros::Publisher odometry_, joints_, blades_;
  tf2_ros::TransformBroadcaster broadcaster_;
  std::thread thread_;
  std::mutex mutex_;
  std::condition_variable stopping_;
  bool stop_ = false;  // guarded by mutex_
};

}  // namespace heerk_rotor
