#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <ros/node_handle.h>

#include "heerk_rotor/config/configuration.hpp"
#include "heerk_rotor/integrate/simulation.hpp"
#include "heerk_rotor/realtime/feed.hpp"
#include "heerk_rotor/ros/automatic_rates.hpp"
#include "heerk_rotor/ros/command_input.hpp"
#include "heerk_rotor/ros/node_parameters.hpp"
#include "heerk_rotor/ros/rotor_diagnostics.hpp"
#include "heerk_rotor/ros/stamp_base.hpp"

namespace heerk_rotor {

/// Everything that tells the outside world of instants: state and display topics, LCM, event log, the history before a failure.
/// The one part of the node that knows what kind of machine is simulated.
class Outlets {
 public:
  struct Context {
    ros::NodeHandle& node;
    const Configuration& configuration;
    const Simulation& simulation;
    const NodeParameters& parameters;
    Rates rates;
    StampBase stamps;
    CommandInput* commands;                   // for LCM; nullptr: no swashplate
    std::function<std::uint64_t()> overruns;  // so far
  };

  /// The last instants before a failure, copied, so that they can be written while the simulation goes on.
  struct History {
    std::size_t instants = 0;
    std::function<void(const std::string& file)> write;
  };

  virtual ~Outlets() = default;

  /// What the step thread gives the instants to.
  virtual Feed& feed() = 0;
  /// Step thread (RealTimeLoop::call()).
  virtual History history() const = 0;

  /// Names the readers; `stop` ends the waiting for the log's reader in runs as fast as possible. Before start().
  virtual void connect(RotorDiagnostics& diagnostics, const std::atomic<bool>& stop) = 0;
  virtual void start() = 0;
  /// After the last step: publishes and writes what is still in the rings.
  virtual void stop() = 0;
  /// What keeps the event log from being complete; empty: nothing.
  virtual std::string recordingProblem() const = 0;
};

/// The outlets for the kind of machine that the system is (machineKind()). Throws what that and LcmLink throw.
std::unique_ptr<Outlets> openOutlets(const Outlets::Context& context);

}  // namespace heerk_rotor
