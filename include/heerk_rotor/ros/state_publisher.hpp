#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "heerk_rotor/realtime/instant.hpp"
#include "heerk_rotor/ros/stamp_base.hpp"
#include "heerk_rotor/ros/state_topics.hpp"

namespace heerk_rotor {

/// Publishes every instant of its ring on the topics of its kind (and /clock), on a thread of its own.
template <class Instant>
class StatePublisher {
 public:
  struct Options {
    StampBase stamps;
    bool publish_clock = false;
    std::function<std::uint64_t()> overruns;  // so far
  };

  /// The ring must outlive the publisher.
  StatePublisher(ros::NodeHandle& node, SnapshotRing<Instant>& ring, const Options& options);
  ~StatePublisher();

  void start();
  /// Publishes what the ring still holds and ends the thread.
  void stop();

  std::uint64_t published() const { return published_; }

 private:
  void publish(const Instant& instant);

  SnapshotRing<Instant>& ring_;
  const Options options_;
  StateTopics<Instant> topics_;
  ros::Publisher clock_;
  std::thread thread_;
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> published_{0};
};

extern template class StatePublisher<RotorInstant>;
extern template class StatePublisher<ShaftInstant>;

}  // namespace heerk_rotor
