#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heerk_rotor {

/// The command line of `simulate`, checked as far as it can be without the configuration.
struct SimulateOptions {
  std::string configuration;            // CONFIG; may be empty with load_snapshot
  std::vector<std::string> overrides;   // --set KEY=VALUE, in order
  std::optional<double> duration;       // [s], from the instant the run starts at
  std::optional<double> revolutions;    // of the nominal rotor speed
  std::vector<std::string> outputs;     // *.csv, *.bag, *.lcm
  std::vector<std::string> signals;     // names as given; empty: the published ones
  std::uint64_t every = 1;              // record every N-th step
  std::string commands;                 // CSV file of commands, or ""
  std::string save_snapshot, load_snapshot;
  bool trim = false, stability = false;
  std::optional<std::string> show_coupling;  // picture to write, or ""
  bool evaluation_counts = false;
  std::string save_start;               // start file to write, or ""; with trim the trimmed start
  std::vector<std::string> sweeps;      // --sweep KEY=VALUES, in order
  std::string sweep_file;               // list of runs, or ""
  std::optional<std::uint64_t> jobs;    // runs of a sweep at a time, >= 1; nothing: one per processor
  bool json = false, quiet = false, list_signals = false;
  std::string help;                     // not empty: print it and do nothing else

  bool isSweep() const { return !sweeps.empty() || !sweep_file.empty(); }
};

/// Throws ConfigurationError with everything that is wrong with the command line.
SimulateOptions parseSimulateOptions(int argc, const char* const* argv);

/// The kind of file an output is, from its name.
enum class OutputKind { kCsv, kBag, kLcm };
std::optional<OutputKind> outputKind(const std::string& file);

}  // namespace heerk_rotor
