#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include <XmlRpcValue.h>

namespace heerk_rotor {

enum class TimeoutPolicy {
  kHold,  // keep the last command
  kTrim   // back to the default command of the configuration
};

/// Private parameters of the node; the comment of each is its manual.
struct NodeParameters {
  std::string config;                   // configuration file, absolute path; required
  std::vector<std::string> set;         // overrides "key=value" of the file, as simulate --set
  double real_time_factor = 1.0;        // simulated over real time; 0 = as fast as possible
  int publish_every = 0;                // rotor/state (shaft/state) and its companions every n-th step; 0 = automatic (automatic_rates.hpp)
  int steps_per_wake = 0;               // steps per wake-up of the step thread; more: fewer wake-ups, coarser deadlines; 0 = automatic
  double command_timeout = 0.5;         // age by arrival at which a swashplate command is stale [s]; 0 = never
  TimeoutPolicy timeout_policy = TimeoutPolicy::kHold;
  bool publish_clock = false;           // publish /clock and stamp with simulation time
  std::string lcm_url;                  // LCM provider; empty = off. Default: kDefaultLcmUrl, which may fail with a warning
  bool lcm_url_given = false;           // another one than the default: it must work
  int lcm_every = 0;                    // ROTOR_STATE (SHAFT_STATE) every n-th step; 0 = automatic
  std::string lcm_log;                  // LCM event log of every step; empty = none
  int priority = 80;                    // SCHED_FIFO priority of the step thread; 0 = normal scheduling
  int lock_step = 0;                    // n: advance n steps per received command; 0 = run freely
  double duration = 0.0;                // end the node after this much simulated time [s]; 0 = endless
  std::string failure_file;             // the revolution before a failed step goes here; empty: heerk_rotor_failure.csv in $ROS_HOME or ~/.ros

  static constexpr const char* kDefaultLcmUrl = "udpm://239.255.76.67:7667?ttl=0";
};

/// what() lists everything wrong with the parameters, one line each.
struct ParameterError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads the private parameters from the struct that the parameter server holds for the node's name (any other type: none
/// set). Unknown names go to `warnings`, with the nearest known one. Throws ParameterError.
NodeParameters readNodeParameters(const XmlRpc::XmlRpcValue& values, std::vector<std::string>& warnings);

}  // namespace heerk_rotor
