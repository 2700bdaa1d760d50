#pragma once
#include <string>

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <std_srvs/Empty.h>

#include "heerk_rotor/LoadSnapshot.h"
#include "heerk_rotor/SaveSnapshot.h"
#include "heerk_rotor/Step.h"
#include "heerk_rotor/integrate/simulation.hpp"
#include "heerk_rotor/realtime/real_time_loop.hpp"
#include "heerk_rotor/ros/rotor_task.hpp"

namespace heerk_rotor {

/// The services ~pause, ~unpause, ~reset, ~step, ~save_snapshot, ~load_snapshot. What touches the simulation runs on the step
/// thread between two steps; files are read and written on the calling thread.
class RotorServices {
 public:
  /// `configuration`: resolved text, stored in snapshots. All references must outlive the services.
  RotorServices(ros::NodeHandle& private_node, Simulation& simulation, RotorTask& task, RealTimeLoop& loop, std::string configuration, bool lock_step);

 private:
  using Empty = std_srvs::Empty;
  bool pause(Empty::Request&, Empty::Response&);
  bool unpause(Empty::Request&, Empty::Response&);
  bool reset(Empty::Request&, Empty::Response&);
  bool step(Step::Request& request, Step::Response& response);
  bool save(SaveSnapshot::Request& request, SaveSnapshot::Response& response);
  bool load(LoadSnapshot::Request& request, LoadSnapshot::Response& response);
  std::string failureText() const;
  std::string whyNoStep(std::uint32_t n) const;

  Simulation& simulation_;
  RotorTask& task_;
  RealTimeLoop& loop_;
  const std::string configuration_;
  const bool lock_step_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace heerk_rotor
