#include "heerk_rotor/ros/state_topics.hpp"

namespace heerk_rotor {
namespace {

// roscpp drops the oldest message of a subscriber that cannot follow; one second at the highest usual rate.
constexpr std::uint32_t kQueue = 3000;

}  // namespace

StateTopics<RotorInstant>::StateTopics(ros::NodeHandle& node)
    : state_(node.advertise<RotorState>("rotor/state", kQueue)),
      lag_(node.advertise<BladeAngles>("rotor/lag_angles", kQueue)),
      wrench_(node.advertise<geometry_msgs::WrenchStamped>("rotor/hub_wrench", kQueue)) {}

void StateTopics<RotorInstant>::publish(const RotorInstant& instant, const ros::Time& stamp, const PublisherNote& note) {
  toRotorState(instant, stamp, note, state_message_);
  state_.publish(state_message_);
  toLagAngles(instant.reading, stamp, lag_message_);
  lag_.publish(lag_message_);
  toHubWrench(instant.reading, stamp, wrench_message_);
  wrench_.publish(wrench_message_);
}

StateTopics<ShaftInstant>::StateTopics(ros::NodeHandle& node) : state_(node.advertise<ShaftState>("shaft/state", kQueue)) {}

void StateTopics<ShaftInstant>::publish(const ShaftInstant& instant, const ros::Time& stamp, const PublisherNote& note) {
  toShaftState(instant, stamp, note, state_message_);
  state_.publish(state_message_);
}

}  // namespace heerk_rotor
