#pragma once
#include <cmath>
#include <cstdint>

#include <ros/time.h>

namespace heerk_rotor {

/// Turns simulation time into header stamps: ROS time at the start of the node plus simulation time.
struct StampBase {
  std::int64_t start = 0;  // stamp of simulation time 0 [ns]; 0 when the node itself publishes /clock

  ros::Time at(double sim_time) const {
    ros::Time stamp;
    return stamp.fromNSec(static_cast<std::uint64_t>(start + std::llround(sim_time * 1e9)));
  }
};

}  // namespace heerk_rotor
