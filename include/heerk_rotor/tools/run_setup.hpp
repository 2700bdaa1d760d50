#pragma once
#include <memory>
#include <string>
#include <vector>

#include "heerk_rotor/config/configuration.hpp"
#include "heerk_rotor/config/simulation_settings.hpp"
#include "heerk_rotor/integrate/simulation.hpp"
#include "heerk_rotor/tools/command_file.hpp"
#include "heerk_rotor/tools/simulate_options.hpp"

namespace heerk_rotor {

/// The simulation a command line asks for, at the instant the run starts from.
struct RunSetup {
  Configuration configuration;
  SimulationSettings settings;
  std::unique_ptr<Simulation> simulation;
  Vector command;                  // w in effect at the start: of the snapshot, otherwise the defaults
  std::vector<std::string> notes;  // about the start file
  std::string json;                // members that analyses before the run add to its summary
};

/// Builds it from CONFIG and --set, or from a snapshot, whose configuration CONFIG and --set must then agree with (only
/// simulation.duration may differ). Throws ConfigurationError, or std::runtime_error for a snapshot that cannot be used.
RunSetup setUpRun(const SimulateOptions& options);

/// Where two configurations say different things, as problems of `given`. Numbers are compared as numbers.
Problems differences(const Configuration& given, const Configuration& expected);

/// The rows of --commands, bound to the swashplate of the system; a warning for each command that is clamped to its travel. Throws
/// ConfigurationError, also when there is no swashplate.
CommandSchedule openCommands(const std::string& file, const Simulation& simulation, std::vector<std::string>& warnings);

}  // namespace heerk_rotor
