#pragma once
#include <string>
#include <vector>

#include "heerk_rotor/tools/run_setup.hpp"
#include "heerk_rotor/tools/step_loop.hpp"

namespace heerk_rotor {

/// Everything that follows the step loop: the final row, complete files, the snapshot, the failure dump, messages on
/// stderr and the summary on stdout. Returns the exit status of `simulate`.
int concludeRun(const SimulateOptions& options, RunSetup& setup, const std::vector<Signal>& signals,
                const StepCompanions& companions, RunSummary summary);

/// "step 12, t = 0.5 s: rotor.lag_1 is not finite: <likely cause>".
std::string text(const StepFailure& failure);

/// Where the last revolution before a failure goes: OUTPUT.failure.csv beside the first output, or ./simulate.failure.csv.
std::string failureFile(const SimulateOptions& options);

/// 0 done, 1 an output is incomplete, 3 the solution failed, 128 + signal when interrupted.
int exitStatus(RunStatus status, int signal);

}  // namespace heerk_rotor
