#pragma once
#include <string>
#include <vector>

#include "heerk_rotor/core/coupled_system.hpp"
#include "heerk_rotor/tools/sweep.hpp"
#include "heerk_rotor/tools/sweep_progress.hpp"
#include "heerk_rotor/tools/sweep_table.hpp"

namespace heerk_rotor {

/// What the columns of a sweep's table are.
struct SweepColumns {
  std::vector<std::string> units;     // of the swept keys; "" for what is no number
  std::vector<Signal> signals;        // --signals, or the published ones, of the first run that can be set up
  std::vector<std::string> warnings;  // about that run, which holds for its neighbours as well
};

/// Tries every swept key once, before anything runs. Throws ConfigurationError for unknown keys, for signals that do not exist, and with the
/// first run's problems when no run at all can be set up. A single value that a model refuses is no error here, but a failed run later.
SweepColumns checkSweep(const SimulateOptions& options, const Sweep& sweep);

/// One run: the configuration with --set and the run's values, as fast as possible. Never throws; what goes wrong is in the outcome.
SweepOutcome runOne(const SimulateOptions& options, const Sweep& sweep, std::uint64_t run, const std::vector<Signal>& columns, SweepProgress& progress) noexcept;

/// The whole sweep on --jobs threads into one file. Workers take the next run when they are free; the file gets the lines in order, each as
/// soon as those before it are there. Runs share nothing that is written (a Simulation per run, built and used by one thread), so the file
/// is the same whatever the number of jobs. Returns the exit status: 0, 1 file incomplete, 3 a run failed, 128 + signal when interrupted.
int runSweep(const SimulateOptions& options);

}  // namespace heerk_rotor
