#pragma once
#include <memory>
#include <string>
#include <vector>

#include "heerk_rotor/assembly/machine_kind.hpp"
#include "heerk_rotor/realtime/command_source.hpp"
#include "heerk_rotor/tools/recorder.hpp"
#include "heerk_rotor/tools/run_setup.hpp"

namespace heerk_rotor {

using Recorders = std::vector<std::unique_ptr<Recorder>>;

/// Opens every --output and lets the simulation show itself to it; the first row will be the present instant.
/// `signals` are the columns of .csv files. Throws ConfigurationError that lists every output that cannot be written.
Recorders openRecorders(const SimulateOptions& options, RunSetup& setup, const std::vector<Signal>& signals);

/// Which messages tell of the system. Throws RecordError when it is neither rotor nor shaft, or offers a quantity twice.
MachineKind recordedKind(const CoupledSystem& system);

/// What a recorder of state messages needs to know besides the system.
struct StateRecording {
  RecordGrid grid;
  CommandSource command_source = CommandSource::kNone;  // kFile when commands come from one
  std::uint64_t disk_reserve = 16u << 20;                // [bytes] recording ends when less is free
};

/// A rosbag with the node's topics. Of a rotor: /rotor/state, /rotor/lag_angles and /rotor/hub_wrench for every recorded instant,
/// /rotor/odom at 100 Hz, /tf and /joint_states at 60 Hz of simulation time (as far as instants are recorded). Of a shaft:
/// /shaft/state for every recorded instant.
/// Stamps and bag time are simulation time + 1 s, because ROS takes the time 0 for "not set".
/// Throws RecordError when the file cannot be opened, the build has no rosbag, or the system is neither rotor nor shaft.
std::unique_ptr<Recorder> openBagRecorder(const std::string& file, const CoupledSystem& system, const StateRecording& recording);

/// An LCM event log as ~lcm_log of the node: channel ROTOR_STATE, or SHAFT_STATE_BATCH; time stamps are simulation time. Errors
/// as for openBagRecorder.
std::unique_ptr<Recorder> openLcmRecorder(const std::string& file, const CoupledSystem& system, const StateRecording& recording);

}  // namespace heerk_rotor
