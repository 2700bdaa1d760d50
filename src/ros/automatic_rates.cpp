#include "heerk_rotor/ros/automatic_rates.hpp"

namespace heerk_rotor {
namespace {

constexpr double kWakeUp = 0.375e-3;      // [s] between wake-ups, each of which costs some 10 us: "about 0.4 ms"
constexpr double kRosPeriod = 1e-3;       // [s] what rospy, rosbag record and rqt follow
constexpr double kLcmPeriod = 1.0 / 3e3;  // [s] what a receiver with its usual buffer follows

/// The least round number of steps that take `period` at least; round, so that the step numbers of a record are.
int steps(double period, double step) {
  constexpr int kMany = 1000000;
  for (int decade = 1; decade < kMany; decade *= 10)
    for (const int factor : {1, 2, 4, 5})
      if (factor * decade * step >= period * (1.0 - 1e-9)) return factor * decade;
  return kMany;
}

}  // namespace

Rates chooseRates(const NodeParameters& parameters, double step) {
  const double pace = parameters.real_time_factor > 0.0 ? parameters.real_time_factor : 1.0;
  const auto choose = [step](int wanted, double period) { return wanted > 0 ? wanted : steps(period, step); };
  return {choose(parameters.steps_per_wake, kWakeUp * pace), choose(parameters.publish_every, kRosPeriod), choose(parameters.lcm_every, kLcmPeriod)};
}

}  // namespace heerk_rotor
