#include "heerk_rotor/ros/state_publisher.hpp"

#include <chrono>

#include <rosgraph_msgs/Clock.h>

namespace heerk_rotor {

using std::chrono::milliseconds;

StatePublisher::StatePublisher(ros::NodeHandle& node, RotorRing& ring, const Options& options) : ring_(ring), options_(options) {
  // roscpp drops the oldest message of a subscriber that cannot follow; one second at the highest usual rate.
  constexpr std::uint32_t kQueue = 3000;
  state_ = node.advertise<RotorState>("rotor/state", kQueue);
  lag_ = node.advertise<BladeAngles>("rotor/lag_angles", kQueue);
  wrench_ = node.advertise<geometry_msgs::WrenchStamped>("rotor/hub_wrench", kQueue);
  if (options_.publish_clock) clock_ = node.advertise<rosgraph_msgs::Clock>("/clock", 100);
}

StatePublisher::~StatePublisher() { stop(); }

void StatePublisher::start() {
  thread_ = std::thread([this] {
    RotorInstant instant;
    for (;;) {
      const bool last_round = stop_;  // read first: what was pushed before stop() is still published
      while (ring_.popWaiting(instant, last_round ? milliseconds(0) : milliseconds(50))) publish(instant);
      if (last_round) return;
    }
  });
}

void StatePublisher::stop() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

void StatePublisher::publish(const RotorInstant& instant) {
  const ros::Time stamp = options_.stamps.at(instant.reading.sim_time);
  if (options_.publish_clock) {  // first: nobody gets a message from the future
    rosgraph_msgs::Clock clock;
    clock.clock = stamp;
    clock_.publish(clock);
  }
  note_.command_source = name(instant.source);
  note_.overruns = options_.overruns();
  note_.dropped = ring_.dropped();
  toRotorState(instant.reading, stamp, note_, state_message_);
  state_.publish(state_message_);
  toLagAngles(instant.reading, stamp, lag_message_);
  lag_.publish(lag_message_);
  toHubWrench(instant.reading, stamp, wrench_message_);
  wrench_.publish(wrench_message_);
  ++published_;
}

}  // namespace heerk_rotor
