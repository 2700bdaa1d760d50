#pragma once
#include <atomic>

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/spinner.h>

#include "heerk_rotor/Trim.h"
#include "heerk_rotor/config/configuration.hpp"
#include "heerk_rotor/integrate/simulation.hpp"
#include "heerk_rotor/realtime/real_time_loop.hpp"
#include "heerk_rotor/ros/rotor_task.hpp"

namespace heerk_rotor {

/// The service ~trim. It computes on a thread and a simulation of its own, so that commands and steps go on meanwhile, and then
/// lets the step thread continue from the equilibrium as from a snapshot.
class TrimService {
 public:
  /// All references must outlive the service.
  TrimService(const ros::NodeHandle& private_node, const Configuration& configuration, Simulation& simulation, RotorTask& task, RealTimeLoop& loop);
  ~TrimService();

  void start();
  /// Gives up a computation that is under way.
  void stop();

 private:
  bool serve(Trim::Request& request, Trim::Response& response);
  void solve(const Trim::Request& request, Trim::Response& response);

  const Configuration& configuration_;
  Simulation& simulation_;
  RotorTask& task_;
  RealTimeLoop& loop_;
  std::atomic<bool> cancel_{false};
  ros::NodeHandle node_;
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
  ros::ServiceServer server_;
};

}  // namespace heerk_rotor
