#pragma once
#include <vector>

#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include "heerk_rotor/assembly/command_view.hpp"
#include "heerk_rotor/ros/held_input.hpp"

namespace heerk_rotor {

/// What acts on the rotor besides the swashplate, each held until the next message:
///   rotor/speed_command    std_msgs/Float64 [rad/s]
///   rotor/wind             geometry_msgs/Vector3Stamped: velocity of the air over ground in odom axes [m/s]
///   rotor/external_wrench  geometry_msgs/WrenchStamped: force at and moment about base_link, in its axes [N], [N m]
/// A stamped message may leave its frame empty; one in another frame is refused.
class DisturbanceInputs {
 public:
  DisturbanceInputs(const CoupledSystem& system, const CommandView& commands);

  void subscribe(ros::NodeHandle& node);

  /// For the step thread (RotorTask::addInput).
  HeldInput& speed() { return speed_; }
  HeldInput& wind() { return wind_; }
  HeldInput& externalWrench() { return external_wrench_; }

 private:
  HeldInput speed_, wind_, external_wrench_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace heerk_rotor
