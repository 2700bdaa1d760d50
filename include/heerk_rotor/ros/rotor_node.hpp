#pragma once
#include <memory>
#include <string>
#include <vector>

#include <ros/ros.h>
#include <std_msgs/Float64MultiArray.h>

#include "heerk_rotor/SwashplateCommand.h"
#include "heerk_rotor/analysis/limit_watch.hpp"
#include "heerk_rotor/assembly/command_view.hpp"
#include "heerk_rotor/config/configuration.hpp"
#include "heerk_rotor/integrate/simulation.hpp"
#include "heerk_rotor/realtime/real_time_loop.hpp"
#include "heerk_rotor/ros/command_input.hpp"
#include "heerk_rotor/ros/disturbance_inputs.hpp"
#include "heerk_rotor/ros/node_parameters.hpp"
#include "heerk_rotor/ros/outlets.hpp"
#include "heerk_rotor/ros/rotor_diagnostics.hpp"
#include "heerk_rotor/ros/rotor_services.hpp"
#include "heerk_rotor/ros/rotor_task.hpp"
#include "heerk_rotor/ros/trim_service.hpp"

namespace heerk_rotor {

/// The node `rotor`: puts simulation, step thread, outlets and services together and watches over them.
/// Threads: the step thread; state publisher; view publisher; LCM sender, receiver and log; roscpp's callbacks.
class RotorNode {
 public:
  enum ExitStatus { kDone = 0, kBadParameters = 2, kSimulationFailed = 3, kRecordingIncomplete = 4 };

  /// Throws ParameterError, ConfigurationError and other std::exceptions whose text says what is wrong.
  explicit RotorNode(const NodeParameters& parameters);
  ~RotorNode();

  /// Runs until ROS shuts down or ~duration is over; returns the exit status.
  int run();

 private:
  void subscribeToCommands();
  void start();
  void supervise();
  void reportFailure();
  void stop();
  int exitStatus();
  RotorTask::Options taskOptions() const;

  const NodeParameters parameters_;
  const Configuration configuration_;
  std::unique_ptr<Simulation> simulation_;
  LimitWatch limits_;
  const CommandView commands_;
  const Rates rates_;
  const StampBase stamps_;
  ros::NodeHandle node_, private_node_{"~"};

  CommandInput input_;
  DisturbanceInputs disturbances_;
  const std::unique_ptr<Outlets> outlets_;
  RotorTask task_;
  MonotonicClock clock_;
  RealTimeLoop loop_;
  RotorServices services_;
  TrimService trim_service_;
  RotorDiagnostics diagnostics_;
  std::vector<ros::Subscriber> subscribers_;
  ros::AsyncSpinner spinner_{2};  // ~step waits for its steps; the other services answer meanwhile

  bool failed_ = false;
  std::int64_t reported_epoch_ = -1;  // of the last failure that was reported
  bool recording_problem_reported_ = false;
};

}  // namespace heerk_rotor
