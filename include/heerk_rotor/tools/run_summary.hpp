#pragma once
#include <cstdint>
#include <string>

#include "heerk_rotor/solve/algebraic_solver.hpp"

namespace heerk_rotor {

enum class RunStatus { kDone, kInterrupted, kSolverStalled, kNonFinite, kOutputFailed };

/// What a run did and cost.
struct RunSummary {
  std::uint64_t steps = 0;       // taken in this run
  double simulated_time = 0.0;   // steps * h [s]
  double wall_time = 0.0;        // of the step loop, recording included [s]
  SolverCounters spent;          // by the steps of this run
  RunStatus status = RunStatus::kDone;
  std::uint64_t state_hash = 0;  // Simulation::stateHash() after the last good step

  double realTimeFactor() const { return wall_time > 0.0 ? simulated_time / wall_time : 0.0; }
};

/// "done", "interrupted", "solver_stalled", "non_finite" or "output_failed".
std::string name(RunStatus status);

/// One JSON object (RFC 8259) on one line: steps, simulated_time, wall_time, real_time_factor (null without steps), solves,
/// newton_iterations, residual_evaluations, factorizations, status, state_hash (16 hexadecimal digits as a string).
std::string json(const RunSummary& summary);

/// The same for people, a few lines.
std::string text(const RunSummary& summary);

}  // namespace heerk_rotor
