#pragma once
#include "heerk_rotor/ros/node_parameters.hpp"

namespace heerk_rotor {

/// How often the node does what it need not do at every step.
struct Rates {
  int steps_per_wake;
  int publish_every;
  int lcm_every;
};

/// As the parameters say; what they leave open (0) follows from the step [s], as the least of 1, 2, 4, 5, 10, 20, 40, 50, 100, ..
/// steps with which
///   wake-ups of the step thread are about 0.4 ms or more of real time apart (at the wanted real-time factor),
///   states come over ROS at 1 kHz of simulation time at most,
///   and over LCM at 3 kHz of simulation time at most.
/// One degree of a rotor of 44.4 rad/s, 0.39 ms, gives 1, 4, 1; 1e-5 s gives 40, 100, 40.
Rates chooseRates(const NodeParameters& parameters, double step);

}  // namespace heerk_rotor
