#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "heerk_rotor/realtime/instant_feed.hpp"
#include "heerk_rotor/ros/automatic_rates.hpp"
#include "heerk_rotor/ros/command_input.hpp"
#include "heerk_rotor/ros/node_parameters.hpp"
#include "heerk_rotor/ros/rotor_diagnostics.hpp"
#include "heerk_rotor/ros/stamp_base.hpp"

namespace heerk_rotor {

/// The node's LCM side: live channels and event log, as the parameters ask for. In a build without LCM it refuses what was
/// asked for explicitly.
template <class Kind>
class LcmLink {
 public:
  struct Plan {
    int every;                // of the live channel: every n-th step
    std::size_t live_ring;    // instants
    std::size_t log_ring;     // instants, 10 s of steps at least
    double expected_steps;    // that the log will hold, for the check of the disk
  };

  /// Throws std::runtime_error when something that was asked for cannot be had; the default URL failing is a warning only.
  /// `commands` nullptr: nothing is subscribed to.
  LcmLink(const NodeParameters& parameters, const Plan& plan, const StampBase& stamps, CommandInput* commands, std::function<std::uint64_t()> overruns);
  ~LcmLink();

  /// Registers the rings as readers; `stop` ends the waiting for the log's reader in runs as fast as possible.
  void connect(InstantFeed<Kind>& feed, RotorDiagnostics& diagnostics, bool lossless, const std::atomic<bool>& stop);
  void start();
  void stop();

  /// What keeps the event log from being complete; empty: nothing.
  std::string recordingProblem() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> impl_;
};

extern template class LcmLink<RotorKind>;
extern template class LcmLink<ShaftKind>;

}  // namespace heerk_rotor
