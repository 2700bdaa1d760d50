#include "heerk_rotor/ros/state_publisher.hpp"

#include <chrono>

#include <rosgraph_msgs/Clock.h>

namespace heerk_rotor {

using std::chrono::milliseconds;

template <class Instant>
StatePublisher<Instant>::StatePublisher(ros::NodeHandle& node, SnapshotRing<Instant>& ring, const Options& options) : ring_(ring), options_(options), topics_(node) {
  if (options_.publish_clock) clock_ = node.advertise<rosgraph_msgs::Clock>("/clock", 100);
}

template <class Instant>
StatePublisher<Instant>::~StatePublisher() {
  stop();
}

template <class Instant>
void StatePublisher<Instant>::start() {
  thread_ = std::thread([this] {
    Instant instant;
    for (;;) {
      const bool last_round = stop_;  // read first: what was pushed before stop() is still published
      while (ring_.popWaiting(instant, last_round ? milliseconds(0) : milliseconds(50))) publish(instant);
      if (last_round) return;
    }
  });
}

template <class Instant>
void StatePublisher<Instant>::stop() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

template <class Instant>
void StatePublisher<Instant>::publish(const Instant& instant) {
  const ros::Time stamp = options_.stamps.at(instant.reading.sim_time);
  if (options_.publish_clock) {  // first: nobody gets a message from the future
    rosgraph_msgs::Clock clock;
    clock.clock = stamp;
    clock_.publish(clock);
  }
  topics_.publish(instant, stamp, {options_.overruns(), ring_.dropped()});
  ++published_;
}

template class StatePublisher<RotorInstant>;
template class StatePublisher<ShaftInstant>;

}  // namespace heerk_rotor
