#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "heerk_rotor/realtime/rotor_instant.hpp"
#include "heerk_rotor/ros/conversions.hpp"
#include "heerk_rotor/ros/stamp_base.hpp"

namespace heerk_rotor {

/// Publishes every instant of its ring as rotor/state, rotor/lag_angles and rotor/hub_wrench (and /clock), on a thread of
/// its own.
class StatePublisher {
 public:
  struct Options {
    StampBase stamps;
    bool publish_clock = false;
    std::function<std::uint64_t()> overruns;  // so far
  };

  /// The ring must outlive the publisher.
  StatePublisher(ros::NodeHandle& node, RotorRing& ring, const Options& options);
  ~StatePublisher();

  void start();
  /// Publishes what the ring still holds and ends the thread.
  void stop();

  std::uint64_t published() const { return published_; }
  const RotorRing& ring() const { return ring_; }

 private:
  void publish(const RotorInstant& instant);

  RotorRing& ring_;
  const Options options_;
  ros::Publisher state_, lag_, wrench_, clock_;
  std::thread thread_;
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> published_{0};

  // Reused, so that publishing does not allocate them anew.
  PublisherNote note_;
  RotorState state_message_;
  BladeAngles lag_message_;
  geometry_msgs::WrenchStamped wrench_message_;
};

}  // namespace heerk_rotor
